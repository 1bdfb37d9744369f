# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""How the hits of a frame change the class probabilities of voxels: the rules of docs/fusion.md, plainly.

A rule holds its own keys of a study. It starts voxels as rows of weights, one a class, and changes rows by hits d, S of the
same shape: in how many draws each class won the voxel, and the sum of its scores over them.
"""

import numpy as np

from map_scores import VoxelMap
from truth import Samples

OTHERS = 65535  # id under which a map file has all classes that a voxel does not name
LEAST = 1e-150
HIT, FULL = np.log(0.7 / 0.3), np.log(0.971 / 0.029)  # log-odds of a hit, and where they are clamped


class Rule:
    def __init__(self, class_count, N=1):
        self.class_count, self.N = class_count, N

    def fresh(self, count):
        return np.zeros((count, self.class_count))

    def named(self, weights, ever_hit):
        """What a map file says of a voxel: {class: weight}."""
        return {label: float(weights[label]) for label in np.flatnonzero(weights).tolist()}


class Blend(Rule):
    def __init__(self, class_count, N=1, K=0.5):
        super().__init__(class_count, N)
        self.K = K

    def updated(self, weights, d, S):
        weights = self.K * weights + (1 - self.K) * S / self.N
        return np.where(weights < 1e-6, 0, weights)


class MaxConfidence(Rule):
    def updated(self, weights, d, S):
        offered = np.maximum(weights, S / self.N)
        best = offered.argmax(axis=1)  # the first of equal ones, which is the lower id
        rows = np.arange(len(best))
        result = np.zeros_like(weights)
        result[rows, best] = offered[rows, best]
        return result


class Vote(Rule):
    def updated(self, weights, d, S):
        return weights + d


class Bayes(Rule):
    """Every class has its own number; those that a file does not name are added up there."""

    def __init__(self, class_count, N=1, doubt=0.05, priors=None, detected=()):
        super().__init__(class_count, N)
        self.doubt, self.priors = doubt, np.full(class_count, 1 / class_count)
        if priors:
            self.priors[:] = (1 - sum(priors)) / (class_count - len(priors))
            self.priors[sorted(detected)] = priors

    def fresh(self, count):
        return np.tile(self.priors, (count, 1))

    def evidence(self, d, S):
        """p(c | z_t) of each voxel."""
        s = np.clip(np.divide(S, d, out=np.zeros_like(S), where=d > 0), self.doubt, 1 - self.doubt)
        result = d * s + (self.N - d.sum(axis=1))[:, None] * self.priors
        for e in range(self.class_count):
            lost = (d[:, e] * (1 - s[:, e]) / (1 - self.priors[e]))[:, None] * self.priors
            lost[:, e] = 0
            result += lost
        return result / self.N

    def updated(self, weights, d, S):
        result = weights * self.evidence(d, S) / self.priors
        return np.maximum(result / result.sum(axis=1, keepdims=True), LEAST)

    def named(self, weights, ever_hit):
        result = {label: float(weights[label]) for label in np.flatnonzero(ever_hit).tolist()}
        return {**result, OTHERS: float(weights[~ever_hit].sum())}


class Top3(Bayes):
    """A row holds the named classes' weights, nan for the others, and in a last column that of the rest."""

    def __init__(self, class_count, N=1, doubt=0.05, **keys):
        super().__init__(class_count, N, doubt)
        self.share = keys.get("lambda", 0.9)

    def fresh(self, count):
        return np.full((count, self.class_count + 1), np.nan)

    def kept(self, p, rest):
        """The best three of {class: p}, ties to the lower id, and the rest with the others."""
        best = sorted(p, key=lambda label: (-p[label], label))
        return {label: p[label] for label in best[:3]}, rest + sum(p[label] for label in best[3:])

    def split(self, p, rest, others):
        """Of a set, the numbers of its classes and of another set's, and what then is left."""
        p = dict(p)
        for label in sorted(others, key=lambda label: (-others[label], label)):
            if label not in p:
                p[label], rest = self.share * rest, (1 - self.share) * rest
        return p, rest

    def fused(self, one, other):
        (p1, rest1), (p2, rest2) = self.split(*one, other[0]), self.split(*other, one[0])
        p, rest = {label: p1[label] * p2[label] for label in p1}, rest1 * rest2
        total = sum(p.values()) + rest
        p, rest = self.kept({label: max(LEAST, value / total) for label, value in p.items()}, rest / total)
        return p, max(LEAST, rest)

    def updated(self, weights, d, S):
        result = weights.copy()
        for row, evidence, won in zip(result, self.evidence(d, S), d > 0):
            won = np.flatnonzero(won).tolist()
            seen = self.kept({label: evidence[label] for label in won}, 1 - sum(evidence[won]))
            if not np.isnan(row[-1]):
                old = {label: row[label] for label in np.flatnonzero(~np.isnan(row[:-1])).tolist()}
                seen = self.fused((old, row[-1]), seen)
            row[:] = np.nan
            row[list(seen[0])], row[-1] = list(seen[0].values()), seen[1]
        return result

    def named(self, weights, ever_hit):
        result = {label: float(weights[label]) for label in np.flatnonzero(~np.isnan(weights[:-1])).tolist()}
        return {**result, OTHERS: float(weights[-1])}


RULES = {"blend": Blend, "max_confidence": MaxConfidence, "vote": Vote, "bayes": Bayes, "top3": Top3}


def winners(keys, labels):
    """Per voxel the class of most points, ties to the lower id."""
    samples = Samples()
    samples.add(keys, labels)
    return samples.owners()[:2]


def hits_of(draws, class_count):
    """Voxels and their hits d, S of a frame; draws: of each one (voxel, class, score) of every position."""
    found = []
    for keys, labels, scores in draws:
        won, label = winners(keys, labels)
        place = np.searchsorted(won, keys)
        mine = label[place] == labels
        best = np.zeros(len(won))
        np.maximum.at(best, place[mine], scores[mine])
        found.append((won, label, best))
    keys, labels, best = (np.concatenate(column) for column in zip(*found))
    voxels, rows = np.unique(keys, return_inverse=True)
    d, S = np.zeros((len(voxels), class_count)), np.zeros((len(voxels), class_count))
    np.add.at(d, (rows.reshape(-1), labels), 1)
    np.add.at(S, (rows.reshape(-1), labels), best)
    return voxels, d, S


class FusedMap:
    def __init__(self, rule):
        self.rule, self.keys, self.weights = rule, np.zeros(0, np.int64), rule.fresh(0)
        self.ever_hit, self.hits = np.zeros((0, rule.class_count), bool), np.zeros(0, int)

    def add(self, keys, d, S):
        new = keys[~np.isin(keys, self.keys)]
        order = np.argsort(np.concatenate([self.keys, new]), kind="stable")
        self.keys = np.concatenate([self.keys, new])[order]
        self.weights = np.concatenate([self.weights, self.rule.fresh(len(new))])[order]
        self.ever_hit = np.concatenate([self.ever_hit, np.zeros((len(new), self.rule.class_count), bool)])[order]
        self.hits = np.concatenate([self.hits, np.zeros(len(new), int)])[order]
        rows = np.searchsorted(self.keys, keys)
        self.weights[rows] = self.rule.updated(self.weights[rows], d, S)
        self.ever_hit[rows] |= d > 0
        self.hits[rows] += 1

    def fade(self, keys):
        """Voxels of the map that decay without a hit."""
        rows = np.searchsorted(self.keys, keys)
        nothing = np.zeros((len(rows), self.rule.class_count))
        self.weights[rows] = self.rule.updated(self.weights[rows], nothing, nothing)

    def contents(self):
        """key -> (log-odds of occupancy, {class: weight}), as a map file has them."""
        log_odds = np.minimum(self.hits * HIT, FULL).tolist()
        return {key: (odds, self.rule.named(weights, ever_hit)) for key, odds, weights, ever_hit
                in zip(self.keys.tolist(), log_odds, self.weights, self.ever_hit)}

    def voxels(self):
        """Every voxel that a frame hit, with its most probable class, ties to the lower id; of a blend."""
        return VoxelMap(self.keys, np.ones(len(self.keys), bool), self.weights.argmax(axis=1), self.weights.max(axis=1))
