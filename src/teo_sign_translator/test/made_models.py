# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Models of the zoo that have learned nothing: random weights over a few words."""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from teo_sign_training.fitting.fitting import ZOO
from teo_sign_translator.pointer.config import POINTER, NetworkConfig, weight_shapes
from teo_sign_translator.pointer.vocabulary import Vocabulary

VOCABULARY = Vocabulary.of(
    ["ana", "pan", "como"], ["Ana", "pan", "comer"], ["N:ms", "NAME:f", "V:ind:pres:1s"], ["YO", "PAN", "NO"]
)


def small_config(name: str = POINTER, *, members: int = 1) -> NetworkConfig:
    return dataclasses.replace(ZOO[name], hidden=16, embedding=12, members=members)


def made_weights(config: NetworkConfig, seed: int = 1) -> dict[str, NDArray[np.float32]]:
    random = np.random.default_rng(seed)
    shapes = weight_shapes(config, VOCABULARY)
    return {name: random.normal(0, 0.3, shape).astype(np.float32) for name, shape in shapes.items()}
