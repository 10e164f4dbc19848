"""python3 experiments/python MODULE ARGUMENTS...: runs ssrlab.MODULE of the package in this folder, as commands of `ssrlab` do."""

import runpy
import sys

if __name__ == "__main__":
    del sys.argv[0]
    runpy.run_module(f"ssrlab.{sys.argv[0]}", run_name="__main__", alter_sys=True)
