"""Network that begins with the weights of one that is exported already."""

from collections.abc import Callable, Iterator
from pathlib import Path

import onnx
import torch
from onnx import numpy_helper
from torch import Tensor, nn

from training.network import Network

Hook = Callable[[nn.Module, tuple[Tensor, ...], Tensor], None]


def start_from(network: Network, path: Path, pictures: Tensor) -> None:
    """Give a network the weights of an exported one, whose normalizations are folded away.

    Each normalization is set to what undoes itself on some pictures (n, 3, rows, cols): its moments
    are those of its input, and its factor and offset take them back.
    """
    hooks = []
    with torch.no_grad():
        for module, (weight, bias) in zip(_convolutions(network), _exported(path), strict=True):
            if isinstance(module, nn.Sequential):
                convolution, normalization = module[0], module[1]
                hooks.append(convolution.register_forward_hook(_undo(normalization, bias)))
            else:
                convolution = module
                convolution.bias.copy_(bias)
            convolution.weight.copy_(weight)
        network.eval()(pictures)
    for hook in hooks:
        hook.remove()
    network.train()


def _undo(normalization: nn.BatchNorm2d, bias: Tensor) -> Hook:
    def hook(_module: nn.Module, _given: tuple[Tensor, ...], found: Tensor) -> None:
        mean, variance = found.mean((0, 2, 3)), found.var((0, 2, 3))
        normalization.running_mean.copy_(mean)
        normalization.running_var.copy_(variance)
        normalization.weight.copy_(torch.sqrt(variance + normalization.eps))
        normalization.bias.copy_(bias + mean)

    return hook


def _convolutions(network: Network) -> Iterator[nn.Module]:
    """Convolutions with what follows them, in the order in which they run."""
    for stage in network.down:
        yield from stage
    for side, up in zip(network.side, network.up, strict=True):
        yield side
        yield up
    yield network.last


def _exported(path: Path) -> Iterator[tuple[Tensor, Tensor]]:
    """Weights and biases of the convolutions of a file, in the order in which they run."""
    graph = onnx.load(path).graph
    arrays = {one.name: torch.tensor(numpy_helper.to_array(one)) for one in graph.initializer}
    for node in graph.node:
        if node.op_type == "Conv":
            yield arrays[node.input[1]], arrays[node.input[2]]
