"""The Python package alone, without ROS and LCM: `pip install . --no-build-isolation` where scripts/setup --python has
installed what it is built with."""

import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = pathlib.Path(__file__).resolve().parent


class BuildByCMake(build_ext):
    """CMake builds the module; the scenes go beside it."""

    def build_extension(self, ext):
        build = pathlib.Path(self.build_temp).resolve()
        build.mkdir(parents=True, exist_ok=True)
        configure = ["cmake", "-S", PROJECT, "-B", build, "-DWHIRL_TWIN_PYTHON=ON", "-DWHIRL_TWIN_ROS=OFF",
                     "-DWHIRL_TWIN_LCM=OFF", "-DWHIRL_TWIN_TESTS=OFF", "-DWHIRL_TWIN_MPI=OFF",
                     f"-DPython3_EXECUTABLE={sys.executable}", "--log-level=WARNING"]
        subprocess.run(configure + (["-G", "Ninja"] if shutil.which("ninja") else []), check=True)
        parallel = ["--parallel", str(self.parallel)] if self.parallel else ["--parallel"]
        subprocess.run(["cmake", "--build", build, "--target", "whirl_twin_native", *parallel], check=True)
        module = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        module.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(next((build / "python/whirl_twin").glob("_native*.so")), module)
        if not self.inplace:
            shutil.copytree(PROJECT / "config/scenes", module.parent / "scenes", dirs_exist_ok=True)


setup(
    version=re.search(r"project\(whirl_twin VERSION ([\d.]+)", (PROJECT / "CMakeLists.txt").read_text())[1],
    packages=["whirl_twin", "whirl_twin.drawing"],
    package_dir={"": "python"},
    package_data={"whirl_twin": ["py.typed", "*.pyi"], "whirl_twin.drawing": ["templates/*"]},
    ext_modules=[Extension("whirl_twin._native", [])],
    cmdclass={"build_ext": BuildByCMake},
)
