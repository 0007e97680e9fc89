from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "teo_lut_executor"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        ("share/teo_lut_executor/lut", ["lut/sign.schema.json"]),
        ("share/teo_lut_executor/lut/lse", sorted(map(str, Path("lut/lse").glob("*.json")))),
        ("share/teo_lut_executor/scores/lse", sorted(map(str, Path("scores/lse").glob("*.yaml")))),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Look-up table of signs and the executor that turns sign tokens into smooth trajectories.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [
            "capture_demonstration = teo_lut_executor.capture_cli:demonstration_main",
            "capture_letters = teo_lut_executor.capture_cli:letters_main",
            "capture_numbers = teo_lut_executor.capture_cli:numbers_main",
            "capture_scores = teo_lut_executor.capture_cli:scores_main",
            "capture_node = teo_lut_executor.capture_node:main",
            "executor_node = teo_lut_executor.executor_node:main",
            "lut = teo_lut_executor.lut_cli:main",
            "perform_scores = teo_lut_executor.perform_cli:main",
            "plan = teo_lut_executor.plan_cli:main",
        ],
    },
)
