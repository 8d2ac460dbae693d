"""Network written as ONNX, as the finder reads it."""

from pathlib import Path

import torch

from rockshape.segmentation.by_network import answer, picture
from training.network import Network


def export(network: Network, path: Path) -> None:
    """Write a network; normalizations are folded into the convolutions before them."""
    network = network.eval().to(memory_format=torch.contiguous_format)
    example = torch.zeros(1, picture.CHANNELS, 4 * answer.STRIDE, 4 * answer.STRIDE)
    partly = path.with_suffix(".part")
    torch.onnx.export(
        network,
        (example,),
        str(partly),
        input_names=["picture"],
        output_names=["answer"],
        dynamic_axes={"picture": {2: "rows", 3: "cols"}, "answer": {2: "rows", 3: "cols"}},
        opset_version=17,
        dynamo=False,
    )
    partly.replace(path)
