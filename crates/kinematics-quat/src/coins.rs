//! The flights of coins in the lanes of a vector, by the series of the file `taylor.rs`: η = ½ (ωx + i ωy) is half the
//! transverse rate, and q the rate at which it turns.

use dynamics::{Flight, SolveError, Toss, Work};
use numerics::lanes::{Real, Simd, compensated_product, complex_product, polar};

use crate::enclosure::Record;
use crate::lockstep::{Clock, Motion, PerLane, store};
use crate::plan::Plan;
use crate::product::turned;
use crate::taylor::Series;
use crate::{Landed, QuaternionSystem};

/// The state of the coin in each lane, in the unit of its [`Flight`].
#[derive(Default)]
#[repr(align(64))]
pub(crate) struct Coins {
    /// P = (w, x, y, z), as in [`Landed`].
    attitude: [PerLane; 4],
    /// η = ½ (ωx + i ωy).
    eta: [PerLane; 2],
    /// The rounding error of η, if it is compensated.
    eta_low: [PerLane; 2],
    /// ½ ωz.
    half_z: PerLane,
    q: PerLane,
    /// The least and the largest |η| of the steps so far.
    moduli: [PerLane; 2],
    /// The longest step so far.
    longest: PerLane,
}

/// Where the series of a step end in one lane.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct End {
    pub(crate) pieces: u64,
    pub(crate) attitude: [f64; 4],
    /// η and its rounding error.
    pub(crate) eta: [[f64; 2]; 2],
    pub(crate) moduli: [f64; 2],
    pub(crate) longest: f64,
}

impl Motion for Coins {
    type Toss = Toss;
    type Flight = Flight;
    type Series<S: Simd> = Series<S>;

    fn flight(toss: &Toss) -> Result<Flight, SolveError> {
        Flight::new(toss)
    }

    #[inline(always)]
    fn timing(flight: &Flight) -> &Flight {
        flight
    }

    #[inline(always)]
    fn series<S: Simd>(simd: S) -> Series<S> {
        Series::new(simd)
    }

    fn launch(&mut self, lane: usize, toss: &Toss, flight: &Flight) {
        let QuaternionSystem { rate_z, q } = QuaternionSystem::new(toss.coin.inertia_ratio(), flight.rate.z);
        for (part, value) in self.attitude.iter_mut().zip([1.0, 0.0, 0.0, 0.0]) {
            part[lane] = value;
        }
        let [x, y, z] = [flight.rate.x, flight.rate.y, rate_z].map(|rate| 0.5 * rate);
        (self.eta[0][lane], self.eta[1][lane], self.half_z[lane], self.q[lane]) = (x, y, z, q);
        (self.eta_low[0][lane], self.eta_low[1][lane]) = (0.0, 0.0);
        (self.moduli[0][lane], self.moduli[1][lane], self.longest[lane]) = (f64::INFINITY, 0.0, 0.0);
    }

    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, plan: &Plan, series: &mut Series<S>, clock: &mut Clock) {
        let load = |numbers: &PerLane| Real::load(simd, numbers);
        let (eta, q, order) = (self.eta.each_ref().map(load), load(&self.q), plan.order);
        let (modulus, direction) = polar(eta);
        if plan.compensates {
            series.expand_eta_compensated(order, q);
        } else {
            series.expand_eta(order, q);
        }
        series.expand(order, modulus, load(&self.half_z));
        let h = clock.step(simd, plan, [series.size(order - 1), series.size(order)]);
        load(&self.moduli[0]).min(modulus).store(&mut self.moduli[0]);
        load(&self.moduli[1]).max(modulus).store(&mut self.moduli[1]);
        load(&self.longest).max(h).store(&mut self.longest);
        let (after, lost) = if plan.compensates {
            let [x, y] = self.eta_low.each_ref().map(load);
            let [x, y] = compensated_product([[eta[0], x], [eta[1], y]], series.turn_of_eta_compensated(order, h));
            ([x[0], y[0]], [x[1], y[1]])
        } else {
            (complex_product(eta, series.turn_of_eta(order, h)), [h.constant(0.0); 2])
        };
        let [u, v] = series.turn(order, h);
        // The direction of η turns v back into the axes of the body.
        let attitude = turned(self.attitude.each_ref().map(load), [u, complex_product(direction, v)]);
        store(attitude, &mut self.attitude);
        store(after, &mut self.eta);
        store(lost, &mut self.eta_low);
    }

    fn landing(&self, lane: usize, flight: &Flight, work: Work) -> Landed {
        let [x, y] = self.eta.each_ref().map(|part| 2.0 * part[lane]);
        let turn = self.attitude.each_ref().map(|part| part[lane]);
        let moduli = self.moduli.each_ref().map(|part| part[lane]);
        let steps = work.accepted_steps;
        let record = Some(Record { steps, moduli, longest: self.longest[lane], ..Record::default() });
        Landed { flight: *flight, turn, rate: flight.rate_at(x, y), work, record, enclosed: None }
    }
}

impl Coins {
    /// Sets `lane` to the start of a step in this state of a [`QuaternionSystem`], with these c and q.
    pub(crate) fn start(&mut self, lane: usize, &[w, x, y, z, rate_x, rate_y]: &[f64; 6], [half_z, q]: [f64; 2]) {
        for (part, value) in self.attitude.iter_mut().zip([w, x, y, z]) {
            part[lane] = value;
        }
        (self.eta[0][lane], self.eta[1][lane]) = (0.5 * rate_x, 0.5 * rate_y);
        (self.half_z[lane], self.q[lane], self.moduli[0][lane]) = (half_z, q, f64::INFINITY);
    }

    /// Where the pieces of a step so far lead, without their number.
    pub(crate) fn end(&self, lane: usize) -> End {
        End {
            pieces: 0,
            attitude: self.attitude.each_ref().map(|part| part[lane]),
            eta: [&self.eta, &self.eta_low].map(|eta| eta.each_ref().map(|part| part[lane])),
            moduli: self.moduli.each_ref().map(|part| part[lane]),
            longest: self.longest[lane],
        }
    }
}
