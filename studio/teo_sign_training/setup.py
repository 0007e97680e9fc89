# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_sign_training"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=[
        "matplotlib",
        "numpy",
        "PyYAML",
        "rich",
        "sacrebleu",
        "torch",
        "typer",
    ],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Making translation models: grammar, corpus, fitting, figures, and the published model.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        # What `ros2 run PACKAGE NAME` runs of packages that are without these commands.
        "teo.commands": [
            "build_morphology = teo_sign_training.cli.build_morphology:main",
            "compare = teo_sign_training.cli.compare:main",
            "evaluate = teo_sign_training.cli.evaluate:main",
            "generate_corpus = teo_sign_training.cli.generate_corpus:main",
            "reproduce_paper = teo_sign_training.cli.reproduce_paper:main",
            "train = teo_sign_training.cli.train:main",
        ],
        # The schema of the cards of models that it runs.
        "teo_sign_translator.back_ends": ["1 = teo_sign_training.lstm256.back_end:load_back_end"],
    },
)
