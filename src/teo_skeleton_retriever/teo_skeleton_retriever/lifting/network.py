# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Small networks that were shown rendered people, of whom everything is known.

`train_lifting` of teo_sign_authoring makes them; the file holds the weights of all, in safetensors.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import safetensors.numpy

from teo_skeleton_retriever.arrays import FloatArray

FILE = Path(__file__).with_name("networks.safetensors")


class Network(NamedTuple):
    """A perceptron: rectified linear units between its layers."""

    weights: tuple[FloatArray, ...]
    """Of each layer. Shape (outputs, inputs) each."""
    biases: tuple[FloatArray, ...]
    """Shape (outputs,) each."""

    def __call__(self, inputs: FloatArray) -> FloatArray:
        """Outputs for n inputs. Shape (n, inputs); the result (n, outputs)."""
        found = inputs
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            found = np.maximum(found @ weight.T + bias, 0.0)
        outputs: FloatArray = found @ self.weights[-1].T + self.biases[-1]
        return outputs


@cache
def load_network(name: str, file: Path = FILE) -> Network:
    """The network of a name: "arms" or "hands"."""
    found = {key: value.astype(np.float64) for key, value in safetensors.numpy.load_file(file).items()}
    layers = range(sum(key.startswith(f"{name}.weight") for key in found))
    return Network(
        tuple(found[f"{name}.weight.{layer}"] for layer in layers),
        tuple(found[f"{name}.bias.{layer}"] for layer in layers),
    )
