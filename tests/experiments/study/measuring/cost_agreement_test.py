"""How well counted costs and estimates predict times: against numbers by hand."""

import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../../experiments/study/measuring/costs/cost_agreement.py")

# Totals by time: a 1 ms, b 2 ms, c 2.5 ms; by fetches: a, c, b. Of the three pairs, b and c are not clearly apart.
TIMES = """shot,technique,point,seed,stage,frame,milliseconds,clock,foreign_load,disturbed
s,,,0,gbuffer,0,50,host_fence,,0
s,v,a,0,total,0,1,host_fence,,0
s,v,a,0,total,1,1,host_fence,,0
s,v,a,0,total,2,90,host_fence,,0
s,v,b,0,total,0,2,host_fence,,0
s,v,c,0,total,0,2.5,host_fence,,0
s,v,a,0,v/x,0,1,host_fence,,0
s,v,b,0,v/x,0,2,host_fence,,0
other,v,a,0,total,0,7,host_fence,,0
"""
ESTIMATES = """shot,technique,point,stage,chip,product,microseconds,refusal
s,v,a,total,navi21,R,4,
s,v,b,total,navi21,R,5,
s,v,c,total,navi21,R,6,
s,v,a,v/x,navi21,R,1,
s,v,b,v/x,navi21,R,0.5,
s,v,a,total,vega10,R,9,
s,v,b,total,vega10,R,3,
s,v,c,total,vega10,R,,a refusal
"""
FETCHES = {("a", "total"): 10, ("b", "total"): 30, ("c", "total"): 20, ("a", "v/x"): 7, ("b", "v/x"): 5}


class CostAgreement(unittest.TestCase):
    def run_on(self, costs, estimates=None, options=()):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("times.csv", TIMES), ("costs.csv", costs), *([("estimates.csv", estimates)] if estimates else [])):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            return subprocess.run([sys.executable, "-B", PROGRAM, folder, *options], capture_output=True, text=True)

    def test_ranks_and_pairs_by_hand(self):
        rows = ["shot,technique,point,stage,quantity,value"]
        for (point, stage), fetches in FETCHES.items():
            for quantity in ("invocations", "texels", "bytes_read", "bytes_written", "unique_bytes", "operations"):
                rows.append(f"s,v,{point},{stage},{quantity},1")
            rows.append(f"s,v,{point},{stage},fetches,{fetches}")
        done = self.run_on("\n".join(rows) + "\n")
        self.assertIn("| fetches | 0.33 [0.33, 0.33] | -1.00 [-1.00, -1.00] | 2 of 2 | - |", done.stdout, done.stderr)
        self.assertIn("| operations | none | none | 0 of 2 | - |", done.stdout)  # ties say nothing

    def test_estimates_of_chips_are_ranked_beside(self):
        costs = "shot,technique,point,stage,quantity,value\ns,v,a,total,fetches,1\n"
        done = self.run_on(costs, ESTIMATES)
        self.assertIn("| navi21 estimate | 1.00 [1.00, 1.00] | -1.00 [-1.00, -1.00] | 2 of 2 | 1000.00 [1000.00, 4000.00] |", done.stdout, done.stderr)
        self.assertIn("| vega10 estimate | -1.00 [-1.00, -1.00] | none | 0 of 1 | - |", done.stdout)  # c was refused
        self.assertNotIn("navi21", self.run_on(costs).stdout)

    def test_totals_are_sums_of_the_stages_that_are_left(self):
        costs = "shot,technique,point,stage,quantity,value\ns,v,a,total,fetches,1\n"
        done = self.run_on(costs, ESTIMATES, ["--without", "w/*"])
        self.assertIn("| navi21 estimate | -1.00 [-1.00, -1.00] | -1.00 [-1.00, -1.00] | 0 of 1 |", done.stdout, done.stderr)
        none_left = self.run_on(costs, ESTIMATES, ["--without", "v/*"])
        self.assertIn("| navi21 estimate | none | none | 0 of 0 | - |", none_left.stdout, none_left.stderr)

    def test_points_without_work_of_their_own_are_left_out_of_a_shot(self):
        """`d` keeps the noise's texture alone in `moves`, which takes a thousandth of what the others take: three pairs in order for nothing."""
        names = "shot,technique,point,seed,stage,frame,milliseconds,clock,foreign_load,disturbed\n"
        times, estimates = names, "shot,technique,point,stage,chip,product,microseconds,refusal\n"
        for shot in ("still", "moves"):
            for technique, ms, microseconds in (("a", 1, 2000), ("b", 2, 1000), ("c", 4, 4000), ("d", 8, 9000)):
                stages = {f"{technique}/trace": (ms, microseconds)}
                if shot == "moves":
                    stages |= {"common/noise": (0.001, 1), "clear": (9, 9)}
                for stage, (of_time, estimate) in stages.items():
                    times += f"{shot},{technique},p,0,{stage},0,{of_time},host_fence,,0\n"
                    estimates += f"{shot},{technique},p,{stage},navi21,R,{estimate},\n"
        with tempfile.TemporaryDirectory() as folder:
            costs = "shot,technique,point,stage,quantity,value\nstill,a,p,a/trace,fetches,1\n"
            for name, text in (("times.csv", times), ("costs.csv", costs), ("estimates.csv", estimates)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            command = [sys.executable, "-B", PROGRAM, folder, "--without", "d/*", "clear", "--by-shot", "--model-range"]
            done = subprocess.run(command, capture_output=True, text=True)
        # Of a, b and c all pairs are clearly apart; a and b are in the wrong order.
        row = "(3 points) | 0.33 [0.33, 0.33] |"
        self.assertIn(f"| navi21 estimate, moves {row}", done.stdout, done.stderr)
        self.assertIn(f"| navi21 estimate, still {row}", done.stdout)
        self.assertIn("| navi21 estimate | 0.33 [0.33, 0.33] | ", done.stdout)
        self.assertIn("| 4 of 6 | 1.00 [0.50, 2.00] |", done.stdout)
        self.assertIn("model_range{0.5, 2}", done.stdout)

    def test_without_a_common_shot(self):
        done = self.run_on("shot,technique,point,stage,quantity,value\nthird,v,a,total,fetches,1\n")
        self.assertEqual((done.returncode, done.stderr), (2, "error: no shot has both times and costs\n"))


COMPILED = """shot,technique,point,stage,pipeline,shader,chip,driver,vgprs,waves,instructions,latency,inverse_throughput
s,v,a,v/x,0,compute,navi21,{driver},8,16,10,40,{cycles}
s,v,a,v/y,0,compute,navi21,{driver},16,16,20,50,30
s,v,b,v/x,0,compute,navi21,{driver},24,12,30,60,50
s,v,b,v/x,0,vertex,navi21,{driver},1,1,1,1,1
"""


class MesaAgreement(unittest.TestCase):
    """Two versions of a compiler: against numbers by hand."""

    def run_on(self, newer, estimates=("", "")):
        program = os.path.join(os.path.dirname(PROGRAM), "mesa_agreement.py")
        with tempfile.TemporaryDirectory() as folder:
            for name, text, estimate in (("older", COMPILED.format(driver="radv Mesa 22", cycles=20), estimates[0]), ("newer", newer, estimates[1])):
                os.mkdir(os.path.join(folder, name))
                for file, content in (("compiled.csv", text), ("estimates.csv", estimate)):
                    if content:
                        with open(os.path.join(folder, name, file), "w", encoding="utf-8") as out:
                            out.write(content)
            return subprocess.run([sys.executable, "-B", program, *(os.path.join(folder, n) for n in ("older", "newer"))], capture_output=True, text=True)

    def test_ranks_and_ratios_by_hand(self):
        newer = COMPILED.format(driver="radv Mesa 25", cycles=40)  # one of three pairs is in another order
        done = self.run_on(newer, (ESTIMATES, ESTIMATES.replace(",R,4,", ",R,8,")))
        self.assertIn("| radv Mesa 25 against radv Mesa 22 | values |", done.stdout, done.stderr)
        self.assertIn("| navi21, instructions | 3 | 1.00 [1.00, 1.00] | 1.00 [1.00, 1.00] |", done.stdout)
        self.assertIn("| navi21, cycles | 3 | 0.33 [0.33, 0.33] | 1.00 [1.00, 2.00] |", done.stdout)
        self.assertIn("| navi21, estimated time of points | 3 | -0.33 [-0.33, -0.33] | 1.00 [1.00, 2.00] |", done.stdout)
        self.assertNotIn("estimated", self.run_on(newer).stdout)

    def test_refuses_one_version(self):
        done = self.run_on(COMPILED.format(driver="radv Mesa 22", cycles=40))
        self.assertEqual((done.returncode, done.stderr), (2, "error: both folders are of radv Mesa 22; run one of them with SSRLAB_MESA\n"))


if __name__ == "__main__":
    unittest.main()
