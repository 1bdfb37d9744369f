# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Trains a network: weighted cross entropy, SGD, poly learning rate ([X], section 3.1)."""

import dataclasses
import time

import numpy as np
import torch
from torch.nn import functional as F

import augment
import nets
from data import HEIGHT, WIDTH, class_weights

SIZES = [(96, 128), (120, 160), (144, 192), (192, 256)]   # of batches in the first part; the last part is of full size


@dataclasses.dataclass(frozen=True)
class Recipe:
    """How a network is trained; with the seed, the frames and the threads it decides its bytes."""

    steps: int
    batch: int = 8
    learning_rate: float = 0.1
    power: float = 0.9          # of the poly rule ([X], equation 6)
    momentum: float = 0.9
    decay: float = 1e-4
    warm_up: int = 50           # steps in which the rate rises
    full_size_from: float = 0.75
    prior: float = 0.5          # share of the weights taken back after training, see unweighted()


def prepared(image):
    return torch.from_numpy(image).contiguous(memory_format=torch.channels_last)


def rate(recipe, step):
    """Poly rule after a short linear rise."""
    poly = (1 - step / recipe.steps) ** recipe.power
    return recipe.learning_rate * poly * min(1, (step + 1) / recipe.warm_up)


def loss_of(net, image, label, weights):
    """At a quarter of the picture's width, twice that of the scores; each fourth pixel stands for its like."""
    scores = net.scores(image)
    label = label[:, 2::4, 2::4]
    return F.cross_entropy(nets.resized(scores, label.shape[1:]), label, weight=weights)


def settled(net, frames, random, with_depth, batches=24, batch=8):
    """Means and variances of batch normalisation, anew for the final weights at full size."""
    for layer in net.modules():
        if isinstance(layer, torch.nn.BatchNorm2d):
            layer.reset_running_stats()
            layer.momentum = None   # a plain mean
    net.train()
    with torch.no_grad():
        for _ in range(batches):
            chosen = random.integers(len(frames), size=batch)
            net.scores(prepared(augment.batch(frames, chosen, (HEIGHT, WIDTH), random, with_depth)[0]))
    return net.eval()


def unweighted(net, weights, share):
    """Takes the weights of the loss back out of the scores: weights w train p_w(c) ~ w(c) p(c), so that
    log w(c) less is the logarithm of p(c) itself. `share` 1 takes all, 0 nothing."""
    known = torch.where(weights > 0, weights, torch.ones_like(weights))
    with torch.no_grad():
        net.last.bias -= share * torch.log(known)
    return net


class Order:
    """Frames in shuffled order, each once an epoch."""

    def __init__(self, count, random):
        self.count, self.random, self.left = count, random, []

    def take(self, n):
        while len(self.left) < n:
            self.left += list(self.random.permutation(self.count))
        taken, self.left = self.left[:n], self.left[n:]
        return taken


def start(name, classes, seed):
    torch.manual_seed(seed)
    return nets.make(name, classes).to(memory_format=torch.channels_last).train()


def fit(name, frames, classes, seed, recipe, say=lambda text: None):
    """The trained network (in eval mode) and its losses, one a step."""
    net, random = start(name, classes, seed), np.random.default_rng(seed)
    with_depth = nets.channels_of(name) == 4
    weights = torch.from_numpy(class_weights(frames.label, classes))
    optimiser = torch.optim.SGD(net.parameters(), recipe.learning_rate, recipe.momentum,
                                weight_decay=recipe.decay, nesterov=True)
    order, losses, began = Order(len(frames), random), [], time.process_time()
    for step in range(recipe.steps):
        for group in optimiser.param_groups:
            group["lr"] = rate(recipe, step)
        full = step >= recipe.full_size_from * recipe.steps
        size = (HEIGHT, WIDTH) if full else SIZES[random.integers(len(SIZES))]
        image, label = augment.batch(frames, order.take(recipe.batch), size, random, with_depth)
        loss = loss_of(net, prepared(image), torch.from_numpy(label), weights)
        optimiser.zero_grad(set_to_none=True)
        loss.backward()
        optimiser.step()
        losses.append(float(loss))
        if (step + 1) % 100 == 0:
            say(f"{name} seed {seed}: step {step + 1}/{recipe.steps}, loss {np.mean(losses[-100:]):.3f}, "
                f"{time.process_time() - began:.0f} s of processor time")
    return unweighted(settled(net, frames, random, with_depth), weights, recipe.prior), losses


def steps_in(name, frames, classes, seconds, few=4, many=24):
    """How many steps so much processor time allows: from what `many` take more than `few`."""
    spent = []
    for steps in (few, few, many):   # the first is to warm up
        began = time.process_time()
        fit(name, frames, classes, 0, Recipe(steps=steps))
        spent.append(time.process_time() - began)
    step = max((spent[2] - spent[1]) / (many - few), 1e-3)
    return max(50, int(seconds / step))
