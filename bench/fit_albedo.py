#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

"""Fits the constants of closures/include/regain/closures/analytic_albedo.h. Needs numpy, scipy.

    fit_truth > truth.txt             bench/fit_truth.cpp, some minutes
    bench/fit_albedo.py < truth.txt   prints the constants as C++, and the errors, in a minute

What is a quotient of polynomials is fitted for the least largest error by the differential
correction algorithm (Cheney and Loeb 1961): each step is a linear program, and the steps lead to
the best quotient there is. The formulas are written out in that header.
"""

import sys

import numpy as np
from scipy.optimize import least_squares, linprog


def quotient(numerator, denominator, target, weight, steps=30, least=0.0):
    """The n and d, d[0] = 1, of the least largest |numerator n / denominator d - target| weight.

    Columns are terms; the denominator's first is 1. It stays above `least`."""
    scale_n, scale_d = abs(numerator).max(0), abs(denominator).max(0)
    numerator, denominator = numerator / scale_n, denominator / scale_d
    rows, p, q = len(target), numerator.shape[1], denominator.shape[1]

    # From least squares, linearised, a few times over.
    best, below = None, np.ones(rows)
    for _ in range(6):
        w = weight / np.maximum(below, 1e-2)
        a = np.c_[numerator, -target[:, None] * denominator[:, 1:]] * w[:, None]
        found = np.linalg.lstsq(a, target * w, rcond=1e-12)[0]
        below = 1 + denominator[:, 1:] @ found[p:]
        if below.min() > 0:
            error = (abs(numerator @ found[:p] / below - target) * weight).max()
            if best is None or error < best[0]:
                best = error, found[:p], np.r_[1, found[p:]]
    if best is None:
        best = (abs(target) * weight).max(), np.zeros(p), np.eye(1, q)[0]
    error, n, d = best
    size = max(1, abs(n).max(), abs(d).max())
    n, d = n / size, d / size

    w = weight[:, None]
    for _ in range(steps):
        a = np.vstack([
            np.c_[-w * numerator, (w * target[:, None] - error) * denominator, -denominator @ d],
            np.c_[w * numerator, (-w * target[:, None] - error) * denominator, -denominator @ d],
            np.c_[np.zeros((rows, p)), least * np.eye(1, q) - denominator, np.zeros(rows)]])
        b = np.r_[np.zeros(2 * rows), np.full(rows, -1e-3)]
        bounds = [(-40, 40)] * p + [(-1, 1)] * q + [(None, None)]
        found = linprog(np.r_[np.zeros(p + q), 1], A_ub=a, b_ub=b, bounds=bounds, method='highs')
        if found.status != 0:
            break
        below = denominator @ found.x[p:p + q]
        if below.min() <= 0:
            break
        now = (abs(numerator @ found.x[:p] / below - target) * weight).max()
        if now >= error:
            break
        done = now > error * 0.999
        error, n, d = now, found.x[:p], found.x[p:p + q]
        if done:
            break
    n, d = n / scale_n, d / scale_d
    return error, n / d[0], d / d[0]


def powers(x, y, exponents):
    return np.stack([x**i * y**j for i, j in exponents], 1)


def rounded(numbers):
    """As a float holds them, with seven digits."""
    return np.array([float(np.float32('%.7g' % x)) for x in numbers])


def show(name, numbers):
    print('    {' + ', '.join('%.7gf' % x if '.' in '%.7g' % x or 'e' in '%.7g' % x else '%.1ff' % x
                             for x in numbers) + '},  // ' + name)


LOSS = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (2, 2), (4, 0)]
BELOW = [(0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (1, 1), (1, 2), (1, 3), (2, 0), (2, 1), (2, 2),
         (3, 1), (4, 0)]
QUADRATIC = [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (2, 0)]
CUBIC = [(0, 0), (0, 1), (0, 2), (0, 3), (1, 0), (1, 1), (1, 2), (2, 0), (2, 1), (3, 0)]


def fit_E_ss(alpha, mu, E):
    """1 - E_ss = m N / D; of N what is left at m = 1, alpha = 0 is 0: a mirror loses nothing."""
    m = mu / (mu + alpha)
    numerator = powers(m, alpha, LOSS) * m[:, None]
    # The sum of the terms without alpha is 0: the last of them follows from the others.
    free = [k for k in range(len(LOSS)) if LOSS[k] != (4, 0)]
    constrained = numerator[:, free].copy()
    for column, k in enumerate(free):
        if LOSS[k][1] == 0:
            constrained[:, column] -= numerator[:, -1]
    # Where nearly nothing is lost errors are seen best.
    weight = np.where((m > 0.995) & (alpha < 3e-3), 2.5, 1) / E
    _, n, d = quotient(constrained, powers(m, alpha, BELOW), 1 - E, weight)
    n = rounded(np.r_[n, -sum(n[c] for c, k in enumerate(free) if LOSS[k][1] == 0)])
    d = rounded(d)
    show('loss', n)
    show('loss_below', d[1:])
    fit = 1 - numerator @ n / (powers(m, alpha, BELOW) @ d)
    ratio = E / np.minimum(fit, 1)
    print('// E_ss / fit: %.5f to %.5f; least denominator %.4f' %
          (ratio.min(), ratio.max(), (powers(m, alpha, BELOW) @ d).min()))
    return lambda a, c: 1 - (c / (c + a)) * (powers(c / (c + a), a, LOSS) @ n) / (
        powers(c / (c + a), a, BELOW) @ d)


def fit_E_avg(alpha, E):
    n_terms, d_terms = [(2, 0), (3, 0)], [(0, 0), (1, 0), (2, 0), (3, 0)]
    _, n, d = quotient(powers(alpha, 0 * alpha, n_terms), powers(alpha, 0 * alpha, d_terms), 1 - E,
                       1 / E, least=0.01)
    n, d = rounded(n), rounded(d)
    show('average_loss', n)
    show('average_loss_below', d[1:])
    fit = 1 - powers(alpha, 0 * alpha, n_terms) @ n / (powers(alpha, 0 * alpha, d_terms) @ d)
    print('// E_avg / fit: %.5f to %.5f' % ((E / fit).min(), (E / fit).max()))


def fit_moments(alpha, mu, E, falloff, dip):
    """The cosine c of a facet with the mean falloff; then dip over that of such a facet."""
    m, s = mu / (mu + alpha), np.sqrt(alpha)
    cosine = 1 - np.maximum(falloff, 0)**0.2
    top, bottom = powers(m, s, CUBIC) * alpha[:, None], powers(m, s, QUADRATIC)
    # Of falloff, and of a dip that leaves nothing at 82 degrees, which both count alike.
    weight = np.maximum(5 * (1 - cosine)**4, 10 * (1 - cosine)**6) * E + 1e-3
    _, n, d = quotient(top, bottom, cosine - mu, weight, least=0.03)
    n, d = rounded(n), rounded(d)
    show('cosine', n)
    show('cosine_below', d[1:])
    fit = np.clip(mu + top @ n / (bottom @ d), 0, 1)
    error = ((1 - fit)**5 - falloff) * E
    print('// falloff: %.5f; least denominator %.4f' % (abs(error).max(), (bottom @ d).min()))

    top = powers(m, alpha, QUADRATIC) * (fit * (1 - fit)**6)[:, None]
    bottom = powers(m, alpha, QUADRATIC)
    _, n, d = quotient(top, bottom, dip, E, least=0.03)
    n, d = rounded(n), rounded(d)
    show('dip', n)
    show('dip_below', d[1:])
    error = (top @ n / (bottom @ d) - dip) * E
    print('// dip: %.6f, of a tint %.4f; least denominator %.4f' %
          (abs(error).max(), 17.65 * abs(error).max(), (bottom @ d).min()))


F0 = np.array([0.02, 0.04, 0.1, 0.2, 0.35, 0.5, 0.8, 0.95])
N = np.array([0.156, 0.424, 1.383, 0.238, 1.007, 1.240, 1.558, 1.015, 0.633, 0.052, 0.060, 0.040,
              1.990, 1.921, 1.729])
K = np.array([3.602, 2.472, 1.916, 3.626, 2.582, 2.393, 7.712, 6.627, 5.454, 4.409, 3.597, 2.648,
              4.209, 3.616, 2.944])


def reflectances(mu):
    mu = np.clip(mu, 0, 1)[:, None]
    s2, t = 1 - mu**2, N**2 - K**2 - 1 + mu**2
    sum2 = np.sqrt(t**2 + 4 * N**2 * K**2)
    a = np.sqrt(np.maximum(0.5 * (sum2 + t), 0))
    s = (sum2 + mu**2 - 2 * a * mu) / (sum2 + mu**2 + 2 * a * mu)
    p = s * (mu**2 * sum2 + s2**2 - 2 * a * mu * s2) / (mu**2 * sum2 + s2**2 + 2 * a * mu * s2)
    return np.c_[F0 + (1 - F0) * (1 - mu)**5, 0.5 * (s + p)]


def fit_later(alpha, mu, E, truth, single, power):
    """q_ms and mu_ms together, for the albedo of `directional`."""
    r, s = np.sqrt(mu), np.sqrt(alpha)
    q_terms, mu_terms = np.stack([r, alpha * r], 1), np.stack([1 + 0 * mu, s, mu, mu * s], 1)
    weight = np.r_[np.full(8, 1 / 5e-3), np.full(15, 1 / 1.2e-2)]

    def errors(numbers):
        q = np.clip(q_terms @ numbers[:2], 0, 0.999)[:, None]
        x = reflectances(mu_terms @ numbers[2:])
        return single * (1 + ((1 - E) / E)[:, None] * x * (1 - q) / (1 - q * x)) - truth

    def powered(numbers):
        e = (errors(numbers) * weight).ravel()
        return np.sign(e) * abs(e)**power

    numbers = least_squares(powered, np.array([0.1, 0.2, -0.05, 0.3, 0.1, 0.1]), x_scale=0.1,
                            max_nfev=400).x
    numbers = np.round(numbers, 4)
    show('later', numbers)
    e = abs(errors(numbers))
    print('// directional: %.4f / %.4f of Schlick, %.4f / %.4f of metals' %
          (e[:, :8].max(), np.sqrt((e[:, :8]**2).mean()), e[:, 8:].max(),
           np.sqrt((e[:, 8:]**2).mean())))


def fit_shape(alpha, loss, spread, forward, tilt):
    """Of tail, cubics in sqrt(alpha), where it has a part in anything."""
    s = np.sqrt(alpha)
    for name, values, weight in (('spread', spread, loss * (forward + 0.02)),
                                 ('forward', forward, loss), ('tilt', tilt, loss)):
        w = np.sqrt(weight)
        terms = powers(s, 0 * s, [(0, 0), (1, 0), (2, 0), (3, 0)])
        n = np.linalg.lstsq(terms * w[:, None], values * w, rcond=None)[0]
        n = np.round(n, 4)
        show(name, n)
        print('// %s: %.3f where alpha >= 0.1' %
              (name, abs(terms @ n - values)[alpha >= 0.1].max()))


def main():
    rows = {}
    for line in sys.stdin:
        words = line.split()
        rows.setdefault((words[1], words[0]), []).append([float(w) for w in words[2:]])
    for distribution, power in (('ggx', 4), ('beckmann', 2)):
        print('// ' + distribution)
        of = {kind: np.array(r) for (name, kind), r in rows.items() if name == distribution}
        alpha, mu, E, falloff, dip = of['albedo'].T
        E_ss = fit_E_ss(alpha, mu, E)
        fit_E_avg(*of['average'].T)
        fit_moments(alpha, mu, E, falloff, dip)
        later = of['later']
        alpha, mu = later[:, 0], later[:, 1]
        # With the fit's own E_ss, for it is what the gain will be taken from.
        fit_later(alpha, mu, E_ss(alpha, mu), later[:, 3:26], later[:, 26:], power)
        fit_shape(*of['shape'].T)


if __name__ == '__main__':
    main()
