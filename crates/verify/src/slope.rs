//! This file fits a straight line to points. The order of convergence, the effect of a tolerance and the error of
//! sampling are all slopes of logarithms.

/// Slope of the least-squares line through `points`, each (x, y); NaN for fewer than two different x.
pub(crate) fn slope(points: &[[f64; 2]]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "dozens")]
    let mean = |part: usize| points.iter().map(|point| point[part]).sum::<f64>() / points.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let (mut across, mut along) = (0.0, 0.0);
    for point in points {
        across += (point[0] - x) * (point[1] - y);
        along += (point[0] - x) * (point[0] - x);
    }
    across / along
}
