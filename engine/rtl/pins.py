#!/usr/bin/env python3
"""pins.py PORTS.json MODULE: a top module with few pins, for place and route of MODULE alone.

Reads the ports from a netlist of Yosys. A shift register gives the inputs, another one takes the outputs, so that paths
from and to the ports are paths between flip-flops.
"""

import json
import sys


def main():
    path, module = sys.argv[1:]
    with open(path, encoding="utf-8") as file:
        ports = json.load(file)["modules"][module]["ports"]
    clocks = [name for name in ports if name.endswith("clk")]
    inputs = [name for name, port in ports.items() if port["direction"] == "input" and name not in clocks]
    outputs = [name for name, port in ports.items() if port["direction"] == "output"]
    width = {name: len(port["bits"]) for name, port in ports.items()}
    in_bits = sum(width[name] for name in inputs)
    out_bits = sum(width[name] for name in outputs)
    print(f"module {module}_pins (")
    for clock in clocks:
        print(f"    input {clock},")
    print("    input scan_in,\n    input load,\n    output scan_out\n);")
    print(f"  reg [{in_bits - 1}:0] given;\n  reg [{out_bits - 1}:0] taken;\n  wire [{out_bits - 1}:0] result;")
    print(f"  {module} module_of_pins (")
    connections = [f".{clock}({clock})" for clock in clocks]
    for bus, names in (("given", inputs), ("result", outputs)):
        low = 0
        for name in names:
            connections.append(f".{name}({bus}[{low + width[name] - 1}:{low}])")
            low += width[name]
    print("      " + ",\n      ".join(connections) + "\n  );")
    print(f"  always @(posedge {clocks[0]}) begin")
    print("    given <= {given, scan_in};\n    taken <= load ? result : {taken, 1'b0};\n  end")
    print(f"  assign scan_out = taken[{out_bits - 1}];\nendmodule")


main()
