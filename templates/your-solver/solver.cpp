// Lands coins by the classical Runge-Kutta scheme of order 4, in steps that fit the tolerance of each question.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

// The attitude w, x, y, z from the body frame to the laboratory frame, and the body rates about x and y.
using State = std::array<double, 6>;

struct Coin {
    double i1, i3, rate_z;

    State slope(const State& s) const {
        const auto [w, x, y, z, a, b] = s;
        const double c = rate_z, precession = (i1 - i3) / i1 * c;
        return {0.5 * (-x * a - y * b - z * c), 0.5 * (w * a + y * c - z * b), 0.5 * (w * b + z * a - x * c),
                0.5 * (w * c + x * b - y * a),  precession * b,                -precession * a};
    }

    State step(const State& s, double h) const {
        const auto moved = [&](const State& slope, double part) {
            State to = s;
            for (std::size_t i = 0; i < to.size(); ++i) to[i] += part * slope[i];
            return to;
        };
        const State a = slope(s), b = slope(moved(a, h / 2)), c = slope(moved(b, h / 2)), d = slope(moved(c, h));
        State to = s;
        for (std::size_t i = 0; i < to.size(); ++i) to[i] += h / 6 * (a[i] + 2 * (b[i] + c[i]) + d[i]);
        return to;
    }
};

int main() {
    std::string line, cell;
    std::getline(std::cin, line);
    std::vector<std::string> names;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
    while (std::getline(std::cin, line)) {
        std::map<std::string, double> q;
        std::istringstream cells(line);
        for (const std::string& name : names) {
            std::getline(cells, cell, ',');
            q[name] = std::strtod(cell.c_str(), nullptr);  // std::stod takes no number below 2.2e-308.
        }
        const std::string id = line.substr(0, line.find(','));
        const double rate = std::hypot(q["rate_x"], q["rate_y"], q["rate_z"]);
        if (rate * q["time"] > 2e3) {
            std::printf("%s,failed,so long a flight would lose its digits\n", id.c_str());
            std::fflush(stdout);
            continue;
        }
        const Coin coin{q["i1"], q["i3"], q["rate_z"]};
        State state{q["w"], q["x"], q["y"], q["z"], q["rate_x"], q["rate_y"]};
        // A step of angle φ is off by about φ^5/120, and a tenth of the tolerance is enough for all of them.
        const double step = std::pow(12 * q["tolerance"], 0.2) / rate;
        const long steps = std::lround(std::ceil(q["time"] / step));
        for (long i = 0; i < steps; ++i) state = coin.step(state, q["time"] / double(steps));
        // The steps keep the norm only to their error, and the answer is judged as it is written.
        const double norm = std::hypot(std::hypot(state[0], state[1]), std::hypot(state[2], state[3]));
        std::printf("%s", id.c_str());
        for (int i = 0; i < 4; ++i) std::printf(",%.17g", state[i] / norm);
        std::printf(",calls=%ld\n", 4 * steps);
        std::fflush(stdout);
    }
}
