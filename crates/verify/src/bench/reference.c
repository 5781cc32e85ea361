/* The reference of `cargo xtask bench`: cos θ at landing by the closed form in f64, in a loop that a compiler vectorises.
 *
 * It prints cos θ of each toss. Then, for each line that it reads, it prints the shortest time of a toss (ns) over some
 * runs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { TOSSES = 4096, RUNS = 40 };

static void cos_tilts(const double *restrict x, const double *restrict y, const double *restrict z,
                      const double *restrict speed, double ratio, double gravity, double *restrict out) {
    for (int i = 0; i < TOSSES; i++) {
        double along = ratio * z[i], across = x[i] * x[i] + y[i] * y[i], squared = across + along * along;
        out[i] = (along * along + across * cos(sqrt(squared) * (speed[i] * (2.0 / gravity)))) / squared;
    }
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

static double part(int i, double square) {
    double whole;
    return modf(i * sqrt(square), &whole);
}

int main(void) {
    double *columns[5];
    for (int c = 0; c < 5; c++)
        if (!(columns[c] = aligned_alloc(64, TOSSES * sizeof(double)))) return 1;
    for (int i = 0; i < TOSSES; i++) {
        columns[0][i] = 1.0 + 59.0 * part(i, 2.0);
        columns[1][i] = 1.0 + 59.0 * part(i, 3.0);
        columns[2][i] = 1.0 + 59.0 * part(i, 5.0);
        columns[3][i] = 3.0 + 2.0 * part(i, 7.0);
    }
    cos_tilts(columns[0], columns[1], columns[2], columns[3], 0.5, 9.81, columns[4]);
    for (int i = 0; i < TOSSES; i++) printf("%.17g\n", columns[4][i]);
    for (int c; fflush(stdout), (c = getchar()) != EOF;) {
        double best = INFINITY;
        for (int run = 0; run < RUNS; run++) {
            double start = now();
            cos_tilts(columns[0], columns[1], columns[2], columns[3], 0.5, 9.81, columns[4]);
            double time = now() - start;
            if (time < best) best = time;
        }
        printf("%.6f\n", best / TOSSES);
    }
    return 0;
}
