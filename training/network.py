"""The network: a U-Net whose widest maps are thin."""

import torch
from torch import Tensor, nn

from rockshape.segmentation.by_network import answer, picture

WIDTHS = (12, 32, 48, 64, 96, 96)


class Network(nn.Module):
    """Logits of rock, border and distance, and a code of width, (n, 4, rows, cols).

    Takes pictures (n, 3, rows, cols) whose sides are multiples of 32.
    """

    def __init__(self) -> None:
        """Draw the weights from torch's generator."""
        super().__init__()
        self.down = nn.ModuleList()
        before = picture.CHANNELS
        for width in WIDTHS:
            self.down.append(nn.Sequential(_layer(before, width), _layer(width, width)))
            before = width
        self.side = nn.ModuleList()
        self.up = nn.ModuleList()
        for width in WIDTHS[-2::-1]:
            self.side.append(nn.Conv2d(before, width, 1))
            self.up.append(_layer(2 * width, width))
            before = width
        self.last = nn.Conv2d(before, answer.CHANNELS, 1)

    def forward(self, pictures: Tensor) -> Tensor:
        """Answers for pictures."""
        value, kept = pictures, []
        for number, stage in enumerate(self.down):
            if number:
                value = nn.functional.max_pool2d(value, 2)
            value = stage(value)
            kept.append(value)
        for side, up, beside in zip(self.side, self.up, kept[-2::-1], strict=True):
            value = nn.functional.interpolate(side(value), scale_factor=2.0, mode="nearest")
            value = up(torch.cat([value, beside], dim=1))
        return self.last(value)


def _layer(before: int, after: int) -> nn.Sequential:
    return nn.Sequential(
        nn.Conv2d(before, after, 3, padding=1, bias=False),
        nn.BatchNorm2d(after),
        nn.ReLU(inplace=True),
    )
