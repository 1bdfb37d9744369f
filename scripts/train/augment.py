# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Augmentation: mirror, zoom, light and colour of the picture, noise and holes of the depth camera."""

import cv2
import numpy as np


def zoomed(color, depth, label, size, random):
    """A part of 60 to 100 % of the frame, at the size (height, width). What is near is nearer by as much."""
    height, width = label.shape
    part = random.uniform(0.6, 1) if random.random() < 0.6 else 1.0
    h, w = int(part * height), int(part * width)
    top, left = random.integers(height - h + 1), random.integers(width - w + 1)
    cut = (slice(top, top + h), slice(left, left + w))
    to = (size[1], size[0])
    color = cv2.resize(np.ascontiguousarray(color[cut]), to, interpolation=cv2.INTER_LINEAR)
    depth = cv2.resize(depth[cut], to, interpolation=cv2.INTER_NEAREST).astype(np.float32) * (part / 5000)
    return color, depth, cv2.resize(label[cut], to, interpolation=cv2.INTER_NEAREST)


def relit(color, random):
    """Gamma, contrast, warmth and saturation; noise; now and then a blur."""
    x = color.astype(np.float32) / 255
    grey = x.mean(2, keepdims=True)
    x = grey + (x - grey) * random.uniform(0.4, 1.5)
    x = np.clip(x * random.uniform(0.65, 1.3) * random.uniform(0.88, 1.12, 3), 0, 1).astype(np.float32)
    x **= np.float32(random.uniform(0.7, 1.4))
    if random.random() < 0.25:
        x = cv2.GaussianBlur(x, (3, 3), random.uniform(0.3, 1.0))
    if random.random() < 0.5:
        x += cv2.resize(random.standard_normal((60, 80, 3), np.float32), x.shape[1::-1],
                        interpolation=cv2.INTER_NEAREST) * np.float32(random.uniform(0, 0.03))
    return np.clip(x * 255, 0, 255)


def holed(depth, random):
    """Noise that grows with the square of the distance; lost edges, lost patches, seldom no depth at all."""
    if random.random() < 0.02:
        return np.zeros_like(depth)
    known = depth > 0
    noise = random.standard_normal(depth.shape, np.float32) * np.float32(random.uniform(0, 0.004))
    depth = (depth + noise * depth * depth) * np.float32(random.uniform(0.97, 1.03))
    if random.random() < 0.5:
        step = cv2.morphologyEx(depth, cv2.MORPH_GRADIENT, np.ones((3, 3), np.uint8))
        known &= ~((step > 0.1 * depth + 0.1) & (random.random(depth.shape, np.float32) < random.uniform(0, 0.9)))
    for _ in range(random.integers(0, 4)):
        height, width = depth.shape
        box = (random.uniform(0, width), random.uniform(0, height)), tuple(random.uniform(4, 40, 2)), random.uniform(0, 180)
        patch = np.zeros(depth.shape, np.uint8)
        cv2.ellipse(patch, box, 1, -1)
        known &= patch == 0
    return np.where(known, np.maximum(depth, 0), 0)


def sample(frames, n, size, random, with_depth):
    """One augmented frame: image (4, H, W) of float32 (3 without depth), label (H, W)."""
    color, depth, label = zoomed(frames.color[n], frames.depth[n], frames.label[n], size, random)
    planes = [relit(color, random)]
    if with_depth:
        planes.append(holed(depth, random)[..., None])
    image = np.concatenate(planes, 2)
    if random.random() < 0.5:
        image, label = image[:, ::-1], label[:, ::-1]
    return image.transpose(2, 0, 1), label


def batch(frames, chosen, size, random, with_depth):
    """Images (N, C, H, W) and labels (N, H, W)."""
    images, labels = zip(*(sample(frames, n, size, random, with_depth) for n in chosen))
    return np.stack(images).astype(np.float32), np.stack(labels).astype(np.int64)
