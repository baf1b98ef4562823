/* The planar riser of c_loop.c with all that the engine's explicit kernel reckons, by hand: moments from a
 * flexibility shared between neighbours (10/12 and 1/12), tension from the bend within segments, directions
 * of nodes from their neighbours, drag shared between neighbours, and the energy balance of every step.
 * Leapfrog: v += dt a(x, v), x += dt v, v half a step behind.
 *
 * Moments are corrected until the turning angles fit: the system of equations is eliminated from both ends
 * at once. Loops run over a multiple of 8 nodes where they can, as in c_loop.c. */
#include <math.h>
#include <stddef.h>

enum { WIDTH = 8, LARGEST = 1024 + 4 * WIDTH };
typedef double array[LARGEST] __attribute__((aligned(64)));

typedef struct {
    double length, ea, ei, mass, added, drag, weight;
    double amplitude, period, ramp;
} riser;

/* Out: x of all nodes at every output, rows of n + 1; work of the top, energy lost to drag (J).
 * Returns 0, or 1 where velocities grew without bound. */
int simulate(const riser *r, int n, const double *height, int outputs, int steps_per_output, double dt,
             double *restrict out_x, double *restrict energy)
{
    static array x, z, vx, vz, tx, tz, nx, nz, length, rl, m, turn, px, pz, qx, qz, kx, kz, factor, inverse, moves;
    const int all = (n + 1 + WIDTH - 1) / WIDTH * WIDTH, middle = n / 2;
    const double l0 = r->length / n, ea = r->ea, il0 = 1.0 / l0, weight = r->weight * l0;
    const double flex = 10.0 / 12.0 * l0 / r->ei, flex_up = l0 / r->ei / 12.0;
    const double bend = ea * l0 * l0 / (72.0 * r->ei * r->ei);
    const double own = 10.0 / 12.0 * r->drag * l0, other = r->drag * l0 / 12.0;
    const double across = dt / ((r->mass + r->added) * l0), cut = dt / (r->mass * l0) - across;
    const double omega = 2.0 * M_PI / r->period, rise = M_PI / r->ramp;
    double supplied = 0.0, lost = 0.0, held = 0.0, power = 0.0;

    for (int i = 0; i < LARGEST; i++) {
        x[i] = vx[i] = vz[i] = m[i] = turn[i] = px[i] = pz[i] = qx[i] = qz[i] = factor[i] = inverse[i] = 0.0;
        z[i] = i <= n ? height[i] : height[n] + (i - n) * l0;
        tx[i] = nx[i] = 0.0, tz[i] = nz[i] = 1.0, length[i] = l0, rl[i] = il0;
        moves[i] = i > 0 && i < n;
    }
    for (int k = 1; k < n; k++) {
        int i = k < middle ? k : n - 1 + middle - k;
        double pivot = flex;
        if (1 < i && i <= middle) pivot -= flex_up * factor[i - 1];
        if (middle <= i && i < n - 1) pivot -= flex_up * factor[i];
        inverse[i] = 1.0 / pivot;
        if (i != middle) factor[i < middle ? i : i - 1] = flex_up * inverse[i];
    }
    for (int o = 0; o < outputs; o++) {
        for (int k = 0; o && k < steps_per_output; k++) {
            for (int i = 0; i < all; i++) {
                double dx = x[i + 1] - x[i], dz = z[i + 1] - z[i];
                double cx = x[i + 2] - x[i], cz = z[i + 2] - z[i];
                double l = sqrt(dx * dx + dz * dz), c = sqrt(cx * cx + cz * cz), share = 1.0 / (l * c);
                length[i] = l, rl[i] = share * c, tx[i] = share * c * dx, tz[i] = share * c * dz;
                nx[i + 1] = share * l * cx, nz[i + 1] = share * l * cz;
            }
            for (int i = 1; i < n; i++) {
                double sine = tx[i] * tz[i - 1] - tz[i] * tx[i - 1];
                double half = sine / (1.0 + tx[i - 1] * tx[i] + tz[i - 1] * tz[i]), q = half * half;
                double angle = 2.0 * half * (1.0 - q * (1.0 / 3 - q * (1.0 / 5 - q * (1.0 / 7 - q * (1.0 / 9 - q / 11)))));
                turn[i] = angle - flex * m[i] - flex_up * (m[i - 1] + m[i + 1]);
            }
            double low = turn[1], up = turn[n - 1];
            for (int j = 2; j < middle; j++) {
                turn[j] = low = turn[j] - factor[j - 1] * low;
                turn[n - j] = up = turn[n - j] - factor[n - j] * up;
            }
            if (2 * middle < n) turn[middle + 1] = up = turn[middle + 1] - factor[middle + 1] * up;
            low = up = turn[middle] = (turn[middle] - factor[middle] * up - factor[middle - 1] * low) * inverse[middle];
            for (int j = 1; j < middle; j++) {
                int a = middle - j, b = middle + j;
                turn[a] = low = turn[a] * inverse[a] - factor[a] * low;
                turn[b] = up = turn[b] * inverse[b] - factor[b - 1] * up;
            }
            if (2 * middle < n) turn[n - 1] = turn[n - 1] * inverse[n - 1] - factor[n - 2] * up;
            for (int i = 1; i < n; i++) m[i] += turn[i];
            for (int i = 0; i < all; i++) {
                double a = m[i], b = m[i + 1], shear = (b - a) * rl[i];
                double pull = ea * (length[i] * il0 - 1.0) + bend * (a * a + a * b + b * b);
                px[i] = pull * tx[i] - shear * tz[i];
                pz[i] = pull * tz[i] + shear * tx[i];
            }
            for (int i = 0; i < all; i++) {
                double along = vx[i] * nx[i] + vz[i] * nz[i];
                double ux = along * nx[i] - vx[i], uz = along * nz[i] - vz[i], speed = sqrt(ux * ux + uz * uz);
                qx[i] = speed * ux, qz[i] = speed * uz;
            }
            double before = power, worked = held;
            power = 0.0;
            for (int i = 1; i <= all; i++) {
                double gx = own * qx[i] + other * (qx[i - 1] + qx[i + 1]);
                double gz = own * qz[i] + other * (qz[i - 1] + qz[i + 1]);
                double fx = px[i] - px[i - 1] + gx, fz = pz[i] - pz[i - 1] - weight + gz;
                double along = cut * (fx * nx[i] + fz * nz[i]);
                power -= moves[i] * (gx * vx[i] + gz * vz[i]);
                kx[i] = moves[i] * (across * fx + along * nx[i]);
                kz[i] = moves[i] * (across * fz + along * nz[i]);
            }
            held = px[n - 1] * vx[n];
            supplied += 0.5 * dt * (held + worked), lost += 0.5 * dt * (power + before);
            double squares = 0.0;
            for (int i = 0; i < all; i++) {
                double a = vx[i] + 0.5 * kx[i], b = vz[i] + 0.5 * kz[i];
                squares += a * a + b * b;
                vx[i] += kx[i], vz[i] += kz[i];
                x[i] += dt * vx[i], z[i] += dt * vz[i];
            }
            if (!(squares < 1e12)) return 1;
            double t = ((double)(o - 1) * steps_per_output + k + 1) * dt, in = t < r->ramp;
            double grown = in ? 0.5 * (1.0 - cos(rise * t)) : 1.0, rate = in ? 0.5 * rise * sin(rise * t) : 0.0;
            x[n] = r->amplitude * sin(omega * t) * grown;
            vx[n] = r->amplitude * (omega * cos(omega * t) * grown + sin(omega * t) * rate);
        }
        for (int i = 0; i <= n; i++) out_x[(size_t)o * (n + 1) + i] = x[i];
    }
    energy[0] = supplied, energy[1] = lost;
    return 0;
}
