/* Explicit time stepping of a hanging pipe that moves along itself: lumped masses, springs, a mass with
 * quadratic drag at the lower end, the top moved. Semi-implicit Euler: v += dt a(u, v), u += dt v, with u
 * from the state at rest. Loops have no branches, so that compilers make vectors of them. */
#include <math.h>
#include <stddef.h>

enum { LARGEST = 4096 };
typedef double array[LARGEST] __attribute__((aligned(64)));

typedef struct {
    double length, ea, mass, end_mass, drag, amplitude, period, ramp;
} hanging;

/* Out: motion of the lower end, and what the tension at the top is beyond that at rest, at every output. */
void heave(const hanging *h, int n, int outputs, int steps_per_output, double dt, double *restrict bottom,
           double *restrict top)
{
    static array u, v, pull;
    const double l0 = h->length / n, k = h->ea / l0, inv = dt / (h->mass * l0);
    const double end = dt / (h->end_mass + 0.5 * h->mass * l0);
    const double omega = 2.0 * M_PI / h->period, rise = M_PI / h->ramp;
    for (int i = 0; i <= n; i++) u[i] = v[i] = 0.0;
    for (int o = 0; o < outputs; o++) {
        for (int s = 0; o && s < steps_per_output; s++) {
            for (int i = 0; i < n; i++) pull[i] = k * (u[i + 1] - u[i]);
            v[0] += end * (pull[0] - h->drag * fabs(v[0]) * v[0]);
            for (int i = 1; i < n; i++) v[i] += inv * (pull[i] - pull[i - 1]);
            for (int i = 0; i < n; i++) u[i] += dt * v[i];
            double t = ((double)(o - 1) * steps_per_output + s + 1) * dt;
            double ramp = t < h->ramp ? 0.5 * (1.0 - cos(rise * t)) : 1.0;
            u[n] = h->amplitude * sin(omega * t) * ramp;
        }
        double t = (double)o * steps_per_output * dt, in = t < h->ramp;
        double r = in ? 0.5 * (1.0 - cos(rise * t)) : 1.0, r1 = in ? 0.5 * rise * sin(rise * t) : 0.0;
        double r2 = in ? 0.5 * rise * rise * cos(rise * t) : 0.0, sine = sin(omega * t);
        double a = r2 * sine + 2.0 * r1 * omega * cos(omega * t) - r * omega * omega * sine;
        bottom[o] = u[0];
        top[o] = k * (u[n] - u[n - 1]) + 0.5 * h->mass * l0 * h->amplitude * a;
    }
}
