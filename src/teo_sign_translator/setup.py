from glob import glob

from setuptools import find_packages, setup

PACKAGE = "teo_sign_translator"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        ("share/teo_sign_translator/models", sorted(glob("models/*"))),
        ("share/teo_sign_translator/data", sorted(glob("data/*"))),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Spanish text to Spanish Sign Language (LSE) tokens: normalisation, sequence-to-sequence models, translator node.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [
            "translator_node = teo_sign_translator.translator_node:main",
            "translate = teo_sign_translator.translate_cli:main",
            "reproduce_paper = teo_sign_translator.reproduce_paper:main",
        ],
    },
)
