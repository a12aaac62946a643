# SPDX-License-Identifier: MIT
# Figures of pairs of groups by SciPy and NumPy, for reference_unit.cpp. Reads a file of lines of numbers, two lines a
# pair; writes lines "PAIR NAME VALUE". SciPy's exact Mann-Whitney test ignores ties, and its two-sided permutation test
# doubles a tail: with ties its permutation test of the distance from the middle is asked instead.
import math
import sys

import numpy
from scipy import stats


def all_different(*groups):
    values = numpy.concatenate(groups)
    return len(set(values)) == len(values)


def say(pair, name, value):
    print(pair, name, repr(float(value)))


def exact(data, statistic, kind):
    return stats.permutation_test(data, statistic, permutation_type=kind, vectorized=False, n_resamples=numpy.inf,
                                  alternative="greater").pvalue


def cliff(a, b, confidence):
    """Cliff's delta with the interval of Feng and Cliff (2004), from the whole matrix of dominances."""
    d = numpy.sign(numpy.subtract.outer(a, b))
    m, n, delta, z = len(a), len(b), d.mean(), stats.norm.ppf(0.5 + confidence / 2)
    if abs(delta) == 1 or m < 2 or n < 2:
        return delta, None, None
    rows, columns = d.mean(axis=1) - delta, d.mean(axis=0) - delta
    variance = (n**2 * (rows**2).sum() + m**2 * (columns**2).sum() - ((d - delta) ** 2).sum()) / (
        m * n * (m - 1) * (n - 1))
    variance = max(variance, (1 - delta**2) / (m * n - 1))
    half = z * math.sqrt(variance) * math.sqrt((1 - delta**2) ** 2 + z**2 * variance)
    bottom = 1 - delta**2 + z**2 * variance
    return delta, max(-1, (delta - delta**3 - half) / bottom), min(1, (delta - delta**3 + half) / bottom)


def compare(pair, a, b):
    normal = stats.mannwhitneyu(a, b, alternative="two-sided", method="asymptotic", use_continuity=True)
    say(pair, "u", normal.statistic)
    say(pair, "u_normal_p", normal.pvalue)
    if all_different(a, b):
        say(pair, "u_exact_p", stats.mannwhitneyu(a, b, alternative="two-sided", method="exact").pvalue)
    if len(a) + len(b) <= 10:
        middle = len(a) * len(b) / 2

        def u_distance(x, y):
            ranks = stats.rankdata(numpy.concatenate([x, y]))
            return abs(ranks[: len(x)].sum() - len(x) * (len(x) + 1) / 2 - middle)

        say(pair, "u_exact_p", exact((a, b), u_distance, "independent"))
        say(pair, "means_p", exact((a, b), lambda x, y: abs(numpy.mean(x) - numpy.mean(y)), "independent"))
    delta, low, high = cliff(a, b, 0.9)
    say(pair, "delta", delta)
    if low is not None:
        say(pair, "delta_low", low)
        say(pair, "delta_high", high)
    for i, rank in enumerate(stats.rankdata(numpy.concatenate([a, b]))):
        say(pair, f"rank{i}", rank)


def correlate(pair, x, y):
    if len(set(x)) == 1 or len(set(y)) == 1 or len(x) < 3:
        return
    r, p = stats.spearmanr(x, y)
    say(pair, "r", r)
    if abs(r) < 1:
        say(pair, "r_t_p", p)
    if len(x) <= 6:
        rx = stats.rankdata(x)
        say(pair, "r_exact_p", exact((y,), lambda z: abs(stats.pearsonr(rx, stats.rankdata(z))[0]), "pairings"))


def smoothness(pair, speeds, rate):
    """Spectral arc length and dimensionless jerk, as their authors define them, with NumPy's transform."""
    if len(speeds) < 3:
        return
    count = 2 ** (math.ceil(math.log2(len(speeds))) + 4)
    amplitudes = abs(numpy.fft.fft(speeds, count))
    amplitudes /= amplitudes.max()
    below = amplitudes[numpy.arange(count) * rate / count <= 10.0]
    high = numpy.nonzero(below >= 0.05)[0]
    arc = below[high[0]: high[-1] + 1]
    say(pair, "sparc", -numpy.sqrt((1 / (len(arc) - 1)) ** 2 + numpy.diff(arc) ** 2).sum())
    jerks = numpy.diff(speeds, 2) * rate**2
    say(pair, "jerk", -((len(speeds) / rate) ** 3) / speeds.max() ** 2 * (jerks**2).sum() / rate)


def distributions(pair, a):
    p, one, two = abs(math.sin(a[0] + 0.1)), len(a), 2.5 * len(a)
    say(pair, "normal_quantile", stats.norm.ppf(p))
    say(pair, "normal_two_sided", 2 * stats.norm.sf(abs(a[0])))
    say(pair, "f", stats.f.cdf(abs(a[0]), one, two))
    say(pair, "f_quantile", stats.f.ppf(p, one, two))
    say(pair, "t_two_sided", 2 * stats.t.sf(abs(a[0]), two))


lines = [numpy.array([float(word) for word in line.split()]) for line in open(sys.argv[1])]
for pair in range(len(lines) // 2):
    a, b = lines[2 * pair], lines[2 * pair + 1]
    compare(pair, a, b)
    common = min(len(a), len(b))
    correlate(pair, a[:common], b[:common])
    distributions(pair, a)
    if abs(a).max() > 0:
        smoothness(pair, abs(a), 50.0)
