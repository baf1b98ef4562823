/* Explicit time stepping of a planar riser: lumped masses, axial springs, bending, normal drag and
 * normal added mass, weight. Semi-implicit Euler: v += dt a(x, v), x += dt v.
 *
 * Segments have unit tangents (tx, tz), nodes the turn between two segments: with t = tan(turn / 2)
 * the bending energy of a node is 2 EI t^2 / l0, its moment 2 EI t / l0, and (1 + t^2) times that is
 * what it puts on the two segments' angles, exact for any turn below 180 degrees.
 *
 * Nodes 0 .. n are real. Loops run over a multiple of 8 nodes, so that none has a remainder; nodes
 * beyond n, and both ends, have no inverse mass and do not move by themselves.
 *
 * Measured with gcc 12 and AVX-512 (3.0 ns per node and step) and left out: roots and reciprocals by one
 * Newton step from their last values, 5-10 % faster; last two loops in one, 10 % slower; vectors of 256
 * bits, 10 % slower; loops with remainders, 10 % slower. */
#include <math.h>
#include <stddef.h>

enum { WIDTH = 8, LARGEST = 1024 + 2 * WIDTH };
typedef double array[LARGEST] __attribute__((aligned(64)));

typedef struct {
    double length, ea, ei, mass, added, drag, weight;
    double amplitude, period, ramp;
} riser;

/* In: static heights of the nodes. Out: x, z and moment of all nodes at every output, rows of n + 1;
 * the moment's place may be NULL. Checking the numbers is the caller's: -ffast-math knows no NaN. */
void simulate(const riser *r, int n, const double *height, int outputs, int steps_per_output,
              double dt, double *restrict out_x, double *restrict out_z,
              double *restrict out_m)
{
    static array x, z, vx, vz, tx, tz, pull, rl, m, half, px, pz, inv, cut, damp;
    const int blocks = (n + 1 + WIDTH - 1) / WIDTH, all = blocks * WIDTH;
    const double l0 = r->length / n, ea = r->ea, il0 = 1.0 / l0;
    const double stiff = 2.0 * r->ei / l0, weight = r->weight * l0;
    const double omega = 2.0 * M_PI / r->period, rise = M_PI / r->ramp;

    for (int i = 0; i < LARGEST; i++) {
        int free = i > 0 && i < n;
        x[i] = vx[i] = vz[i] = m[i] = px[i] = pz[i] = 0.0;
        z[i] = i <= n ? height[i] : height[n] + (i - n) * l0;
        tx[i] = 0.0, tz[i] = 1.0, half[i] = 0.5, pull[i] = 0.0, rl[i] = il0;
        inv[i] = free ? dt / (r->mass * l0) : 0.0;
        cut[i] = free ? dt / ((r->mass + r->added) * l0) - inv[i] : 0.0;
        damp[i] = free ? dt * r->drag / (r->mass + r->added) : 0.0;
    }
    for (int o = 0; o < outputs; o++) {
        for (int k = 0; o && k < steps_per_output; k++) {
            for (int i = 0; i < all; i++) { /* segment i joins nodes i and i + 1 */
                double dx = x[i + 1] - x[i], dz = z[i + 1] - z[i];
                double l2 = dx * dx + dz * dz, q = 1.0 / sqrt(l2);
                tx[i] = dx * q, tz[i] = dz * q, rl[i] = q;
                pull[i] = ea * (l2 * q * il0 - 1.0);
            }
            for (int i = 1; i <= all; i++) { /* node i, between segments i - 1 and i */
                double h = 1.0 / (1.0 + tx[i - 1] * tx[i] + tz[i - 1] * tz[i]);
                double t = h * (tx[i] * tz[i - 1] - tz[i] * tx[i - 1]);
                half[i] = 0.5 * h;
                m[i] = stiff * t * (1.0 + t * t);
            }
            m[n] = 0.0;
            for (int i = 0; i < all; i++) { /* what segment i does to its lower node */
                double shear = (m[i + 1] - m[i]) * rl[i];
                px[i] = pull[i] * tx[i] - shear * tz[i];
                pz[i] = pull[i] * tz[i] + shear * tx[i];
            }
            for (int i = 1; i <= all; i++) {
                double fx = px[i] - px[i - 1], fz = pz[i] - pz[i - 1] - weight;
                double nx = tz[i - 1] + tz[i], nz = -tx[i - 1] - tx[i], nn = half[i];
                double vn = vx[i] * nx + vz[i] * nz;
                double a = nn * (cut[i] * (fx * nx + fz * nz) - damp[i] * sqrt(nn) * fabs(vn) * vn);
                vx[i] += inv[i] * fx + a * nx, vz[i] += inv[i] * fz + a * nz;
                x[i] += dt * vx[i], z[i] += dt * vz[i];
            }
            double t = ((double)(o - 1) * steps_per_output + k + 1) * dt;
            double ramp = t < r->ramp ? 0.5 * (1.0 - cos(rise * t)) : 1.0;
            x[n] = r->amplitude * sin(omega * t) * ramp;
        }
        const size_t row = (size_t)o * (n + 1);
        for (int i = 0; i <= n; i++) out_x[row + i] = x[i], out_z[row + i] = z[i];
        for (int i = 0; out_m && i <= n; i++) out_m[row + i] = m[i];
    }
}
