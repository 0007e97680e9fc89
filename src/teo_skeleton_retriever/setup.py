from setuptools import find_packages, setup

PACKAGE = "teo_skeleton_retriever"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description=(
        "From colour and depth images to 3D keypoints of people's bodies, hands and faces: "
        "node, detectors, offline tools, synthetic signer."
    ),
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [
            "retrieve = teo_skeleton_retriever.retrieve_cli:main",
            "synthesize = teo_skeleton_retriever.synthetic.synthesize_cli:main",
            "sensor_study = teo_skeleton_retriever.sensor_study:main",
            "retriever_node = teo_skeleton_retriever.retriever_node:main",
        ],
    },
)
