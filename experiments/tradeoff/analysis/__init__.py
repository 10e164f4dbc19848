import os
import sys

# What the scripts of experiments/ share.
EXPERIMENTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir)
sys.path[1:1] = [os.path.join(EXPERIMENTS, "figures"), os.path.join(EXPERIMENTS, "python")]
