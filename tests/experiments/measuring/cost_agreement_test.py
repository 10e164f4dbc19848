"""How well counted costs predict times: against numbers by hand."""

import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../experiments/measuring/costs/cost_agreement.py")

# Totals by time: a 1 ms, b 2 ms, c 2.5 ms; by fetches: a, c, b. Of the three pairs, b and c are not clearly apart.
TIMES = """shot,variant,point,seed,stage,frame,milliseconds,clock,foreign_load,disturbed
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
FETCHES = {("a", "total"): 10, ("b", "total"): 30, ("c", "total"): 20, ("a", "v/x"): 7, ("b", "v/x"): 5}


class CostAgreement(unittest.TestCase):
    def run_on(self, costs):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("times.csv", TIMES), ("costs.csv", costs)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            return subprocess.run([sys.executable, "-B", PROGRAM, folder], capture_output=True, text=True)

    def test_ranks_and_pairs_by_hand(self):
        rows = ["shot,variant,point,stage,quantity,value"]
        for (point, stage), fetches in FETCHES.items():
            for quantity in ("invocations", "texels", "bytes_read", "bytes_written", "unique_bytes", "operations"):
                rows.append(f"s,v,{point},{stage},{quantity},1")
            rows.append(f"s,v,{point},{stage},fetches,{fetches}")
        done = self.run_on("\n".join(rows) + "\n")
        self.assertIn("| fetches | 0.33 [0.33, 0.33] | -1.00 [-1.00, -1.00] | 2 of 2 |", done.stdout, done.stderr)
        self.assertIn("| operations | none | none | 0 of 2 |", done.stdout)  # ties say nothing

    def test_without_a_common_shot(self):
        done = self.run_on("shot,variant,point,stage,quantity,value\nthird,v,a,total,fetches,1\n")
        self.assertEqual((done.returncode, done.stderr), (2, "error: no shot has both times and costs\n"))


if __name__ == "__main__":
    unittest.main()
