"""Predicts a value at points that were not tried, from those that were: a Gaussian process (Rasmussen & Williams 2006, "Gaussian Processes
for Machine Learning", algorithm 2.1 and section 5.4.1).

Points are rows of coordinates from 0 to 1. The covariance is the squared exponential with a length scale for each coordinate, plus noise.
Length scales and noise are the most probable ones, given priors that keep few points from being overfitted. scikit-learn's process has no
such priors: with it, searches of `mcguire_dda` took 1.9 times as many points to 80 % of the best area (tests/experiments/tune)."""

import math

import numpy as np
from scipy import linalg, optimize

LENGTH, NOISE = 1.5, 0.05  # medians of the priors: lengths of the unit cube's edges, and standard deviations of the values
SPREAD = 1.0  # standard deviation of the priors' logarithms
JITTER = 1e-8  # a variance that keeps covariances of alike points invertible


def _squares(a, b, weights):
    """Weighted squared distances of all rows of `a` to all of `b`."""
    a, b = a * np.sqrt(weights), b * np.sqrt(weights)
    return np.maximum((a**2).sum(1)[:, None] + (b**2).sum(1)[None] - 2 * a @ b.T, 0)


def fitted(points, values, begin=None):
    """Logarithms of the most probable length scales and noise. `points`: N x D; `values`: N of mean 0 and deviation 1; `begin`: where to
    begin, the priors' medians by default."""
    count, axes = points.shape
    apart = (points[:, None, :] - points[None]) ** 2
    medians = np.append(np.full(axes, math.log(LENGTH)), math.log(NOISE))

    def cost(logs):
        """Negative logarithm of the posterior, with the likelihood at its best signal variance; and its gradient."""
        weights, noise = np.exp(-2 * logs[:axes]), math.exp(2 * logs[axes])
        signal = np.exp(-0.5 * (apart @ weights))
        try:
            factor = linalg.cho_factor(signal + (noise + JITTER) * np.eye(count), lower=True, check_finite=False)
        except linalg.LinAlgError:
            return 1e9, np.zeros(axes + 1)
        inverse = linalg.cho_solve(factor, np.eye(count), check_finite=False)
        solved = inverse @ values
        variance = max(values @ solved / count, JITTER)  # 0 if all values are the same
        slope = inverse - np.outer(solved, solved) / variance  # twice the likelihood's derivative by the covariance
        of_lengths = 0.5 * np.tensordot(slope * signal, apart, 2) * weights
        from_prior = (logs - medians) / SPREAD
        least = 0.5 * count * math.log(variance) + np.log(np.diag(factor[0])).sum() + 0.5 * from_prior @ from_prior
        return least, np.append(of_lengths, np.trace(slope) * noise) + from_prior / SPREAD

    limits = [(-3, 5)] * axes + [(-7, 0)]
    return optimize.minimize(cost, medians if begin is None else begin, jac=True, method="L-BFGS-B", bounds=limits, options={"maxiter": 30}).x


class GaussianProcess:
    def __init__(self, points, values, begin=None, like=None):
        """`points`: N x D, from 0 to 1; `values`: N; `begin`: a process from whose length scales and noise the fit begins; `like`: one
        whose scales are kept in place of a fit."""
        self.points, self.values = points, values
        self.mean, self.scale = (like.mean, like.scale) if like else (values.mean(), values.std() or 1.0)
        unit = (values - self.mean) / self.scale
        self.logs = like.logs if like else fitted(points, unit, begin.logs if begin else None)
        self.weights = np.exp(-2 * self.logs[:-1])
        covariance = np.exp(-0.5 * _squares(points, points, self.weights)) + (math.exp(2 * self.logs[-1]) + JITTER) * np.eye(len(points))
        self.factor = linalg.cholesky(covariance, lower=True)
        self.solved = linalg.cho_solve((self.factor, True), unit)
        self.variance = like.variance if like else max(unit @ self.solved / len(points), JITTER)

    def predict(self, points):
        """(means, standard deviations) of the value without noise, at M x D points."""
        shared = np.exp(-0.5 * _squares(points, self.points, self.weights))
        explained = linalg.solve_triangular(self.factor, shared.T, lower=True)
        left = np.maximum(1 - (explained**2).sum(0), 0) * self.variance
        return self.mean + self.scale * shared @ self.solved, self.scale * np.sqrt(left)

    def believing(self, point):
        """This process as if its own mean at a point had been measured there: the means stay as they are, and less is uncertain nearby."""
        value = self.predict(point[None])[0]
        return GaussianProcess(np.vstack([self.points, point]), np.append(self.values, value), like=self)
