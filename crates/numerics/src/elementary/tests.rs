//! Tests of roots, exponentials and angles in every kind of number.

use super::*;

#[test]
fn functions_keep_the_precision_of_their_argument_also_where_they_are_exact() {
    for value in [0.0, 1.0, 0.3] {
        let number = exactly(0.0).with_precision(200).value().like(value);
        let [sin, cos] = number.sine_and_cosine();
        let zero = number.like(0.0);
        let angles = [Elementary::atan2(&number, &zero), Elementary::atan2(&zero, &number)];
        let [up, along] = angles;
        let results = [Elementary::exp(&number), Elementary::sqrt(&number), sin, cos, up, along];
        for result in results.into_iter().chain([number.pi(), number.halved(), zero]) {
            assert_eq!(Elementary::digits(&result), 200, "{value}: {result}");
        }
    }
}
