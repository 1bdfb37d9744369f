# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""The networks of [R] and [X] in 0.2 million parameters.

[R] Ruan et al. 2022 compares FCN, PSPNet and CBAM-PSPNet; [X] Xin et al. 2023 an RGB-D fusion network
with itself without depth. The papers' ResNet-50 and VGG-16 are replaced by one small residual encoder,
the same in all five, so that they differ in what the papers say and in nothing else.

Input N x 4 x H x W: red, green, blue in 0..255 and depth in metres, 0 = none; nets of colour read the
first three channels, and take three alone too. Output N x K x H x W: logits. Normalisation is inside.
"""

import torch
from torch import nn
from torch.nn import functional as F

WIDTHS = (16, 32, 48, 60)   # so that every file stays below 1 MB of single floats
NETS = ("fcn", "pspnet", "cbam_pspnet", "rgb", "rgbd")


def convolution(inputs, outputs, size=3, stride=1, dilation=1, groups=1):
    """Convolution, batch normalisation and ReLU; the picture's size divided by the stride."""
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, size, stride, dilation * (size // 2), dilation, groups, bias=False),
        nn.BatchNorm2d(outputs), nn.ReLU(inplace=True))


def separable(inputs, outputs, dilation):
    """Depthwise 3 x 3, then pointwise ([X], figure 4)."""
    return nn.Sequential(convolution(inputs, inputs, 3, dilation=dilation, groups=inputs),
                         convolution(inputs, outputs, 1))


def resized(x, size):
    size = [int(n) for n in size]   # constants of the exported graph
    return F.interpolate(x, size=size, mode="bilinear", align_corners=False)


class Attention(nn.Module):
    """CBAM: which channels, then which places ([R], equations 1 and 2)."""

    def __init__(self, channels, reduction=8):
        super().__init__()
        self.shared = nn.Sequential(nn.Conv2d(channels, channels // reduction, 1), nn.ReLU(inplace=True),
                                    nn.Conv2d(channels // reduction, channels, 1))
        self.place = nn.Conv2d(2, 1, 7, padding=3)

    def forward(self, x):
        size = (int(x.shape[2]), int(x.shape[3]))
        channels = self.shared(F.avg_pool2d(x, size)) + self.shared(F.max_pool2d(x, size))
        x = x * torch.sigmoid(channels)
        place = torch.cat([x.mean(1, keepdim=True), x.amax(1, keepdim=True)], 1)
        return x * torch.sigmoid(self.place(place))


class Residual(nn.Module):
    """Two 3 x 3 convolutions beside a short cut; attention before the sum ([R], figure 3)."""

    def __init__(self, inputs, outputs, stride=1, dilation=1, attention=False):
        super().__init__()
        self.first = convolution(inputs, outputs, 3, stride, dilation)
        self.second = nn.Sequential(nn.Conv2d(outputs, outputs, 3, 1, dilation, dilation, bias=False),
                                    nn.BatchNorm2d(outputs))
        self.attention = Attention(outputs) if attention else None
        self.short = None
        if inputs != outputs or stride != 1:
            self.short = nn.Sequential(nn.Conv2d(inputs, outputs, 1, stride, bias=False), nn.BatchNorm2d(outputs))

    def forward(self, x):
        y = self.second(self.first(x))
        if self.attention is not None:
            y = self.attention(y)
        return F.relu(y + (x if self.short is None else self.short(x)))


def encoder(attention=False, dilated=True):
    """Of colour: stages at 1/2, 1/4, 1/8 and, dilated, 1/8 twice more; else the last two at 1/16."""
    a, b, c, d = WIDTHS
    return nn.ModuleList([convolution(3, a, 3, 2),
                          Residual(a, b, 2, attention=attention),
                          Residual(b, c, 2, attention=attention),
                          Residual(c, d, 1 if dilated else 2, 2 if dilated else 1, attention),
                          Residual(d, d, 1, 4 if dilated else 1, attention)])


def depth_encoder():
    """One convolution a stage, of the widths of colour, without the last stage ([X], section 2.1)."""
    a, b, c, d = WIDTHS
    return nn.ModuleList([convolution(3, a, 3, 2), convolution(a, b, 3, 2), convolution(b, c, 3, 2),
                          convolution(c, d, 3, 1, 2)])


class Normalised(nn.Module):
    """Plain pixels in, centred colours and three channels of depth out."""

    @staticmethod
    def colour(x):
        return x[:, :3] * (1 / 64) - 1.8

    @staticmethod
    def depth(x):
        """Distance, nearness (linear over the picture of a plane) and whether there is any."""
        z = x[:, 3:4]
        known = 1 - F.relu(1 - z * 100)   # no Clip, which OpenCV 4.6 reads from attributes alone
        near = known / (F.relu(z - 0.4) + 0.4)
        return torch.cat([z * 0.4 - known, near * 2 - known, known], 1)


class Segmenter(nn.Module):
    """`scores` at 1/8 of the picture's size, enlarged to its own. `last`: the layer whose bias is that of the scores."""

    def forward(self, image):
        return resized(self.scores(image), image.shape[2:])


class FCN(Segmenter):
    """Scores at 1/16 and 1/8, summed and enlarged (Long et al. 2015, the shape of FCN-8s)."""

    def __init__(self, classes):
        super().__init__()
        self.encoder = encoder(dilated=False)
        self.fine = nn.Conv2d(WIDTHS[2], classes, 1)
        self.last = nn.Conv2d(WIDTHS[3], classes, 1)

    def scores(self, image):
        x, taps = Normalised.colour(image), []
        for stage in self.encoder:
            x = stage(x)
            taps.append(x)
        return resized(self.last(x), taps[2].shape[2:]) + self.fine(taps[2])


def pooled(x, bins):
    """Averages over bins x bins parts, with kernels of fixed size."""
    height, width = int(x.shape[2]), int(x.shape[3])
    step = (height // bins, width // bins)
    return F.avg_pool2d(x, (height - step[0] * (bins - 1), width - step[1] * (bins - 1)), step)


class PSPNet(Segmenter):
    """Pyramid pooling over bins of 1, 2, 3 and 6 (Zhao et al. 2017); with attention CBAM-PSPNet of [R]."""

    BINS = (1, 2, 3, 6)

    def __init__(self, classes, attention, mixed=48):
        super().__init__()
        width = WIDTHS[3]
        self.encoder = encoder(attention)
        self.levels = nn.ModuleList([convolution(width, width // 4, 1) for _ in self.BINS])
        self.mix = convolution(2 * width, mixed)
        self.last = nn.Conv2d(mixed, classes, 1)

    def scores(self, image):
        x = Normalised.colour(image)
        for stage in self.encoder:
            x = stage(x)
        levels = [resized(level(pooled(x, bins)), x.shape[2:]) for level, bins in zip(self.levels, self.BINS)]
        return self.last(self.mix(torch.cat([x, *levels], 1)))


class Fusion(Segmenter):
    """[X], section 2.1: depth features are added to those of colour stage by stage; the last stage is of
    colour alone and dilated; four parallel paths (1 x 1; one and two separable 3 x 3 with dilation 12;
    maximum of 3 x 3) are joined. Without `depth` the network of colours that [X] compares with."""

    DILATION = 12

    def __init__(self, classes, depth, path=32):
        super().__init__()
        width = WIDTHS[3]
        self.colour = encoder()
        self.depth = depth_encoder() if depth else None
        self.point = convolution(width, path, 1)
        self.three = separable(width, path, self.DILATION)
        self.five = nn.Sequential(separable(width, path, self.DILATION), separable(path, path, self.DILATION))
        self.greatest = nn.Sequential(nn.MaxPool2d(3, 1, 1), convolution(width, path, 1))
        self.last = nn.Conv2d(4 * path, classes, 1)

    def scores(self, image):
        x = Normalised.colour(image)
        z = None if self.depth is None else Normalised.depth(image)
        for n, stage in enumerate(self.colour):
            x = stage(x)
            if z is not None and n < len(self.depth):
                z = self.depth[n](z)
                x = x + z
        joined = torch.cat([self.point(x), self.three(x), self.five(x), self.greatest(x)], 1)
        return self.last(joined)


def make(name, classes):
    """A network by its name in NETS, for so many classes (with background)."""
    return {"fcn": lambda: FCN(classes), "pspnet": lambda: PSPNet(classes, False),
            "cbam_pspnet": lambda: PSPNet(classes, True), "rgb": lambda: Fusion(classes, False),
            "rgbd": lambda: Fusion(classes, True)}[name]()


def channels_of(name):
    """Channels of the network's input: 4 with depth."""
    return 4 if name == "rgbd" else 3
