# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_sign_translator"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=["numpy", "PyYAML", "rich", "safetensors", "threadpoolctl", "typer"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Spanish text to Spanish Sign Language (LSE) tokens: models and translator node.",
    license="Apache-2.0",
    extras_require={
        "test": ["hypothesis", "pytest", "simplemma"],
    },
    entry_points={
        "console_scripts": [
            "translator_node = teo_sign_translator.node.translator_node:main",
            "translate = teo_sign_translator.cli.translate:main",
            "generate_corpus = teo_common.installed_packages:main",
            "build_morphology = teo_common.installed_packages:main",
            "train = teo_common.installed_packages:main",
            "evaluate = teo_common.installed_packages:main",
            "compare = teo_common.installed_packages:main",
            "reproduce_paper = teo_common.installed_packages:main",
        ],
        "teo_lut_executor.lut_commands": ["coverage = teo_sign_translator.cli.coverage:coverage"],
    },
)
