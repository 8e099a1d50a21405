"""What the interpreter asks of a call that takes long: it ends with it, and with Ctrl-C."""

import subprocess
import sys

import pytest


def test_the_end_with_a_thread_in_a_step():
    program = """
import threading, time, ostium
data = ostium.Data(ostium.Model(ostium.Vessel("rca-mid-focal"), tools=[("w", "wire-014-workhorse")], begin="RCA"))
threading.Thread(target=data.step, args=(10**6,), daemon=True).start()
time.sleep(0.5)
"""
    assert subprocess.run([sys.executable, "-c", program], capture_output=True).returncode == 0


@pytest.mark.parametrize("call", [
    "data.step(10**6)",
    "ostium.Batch(model, 2).step(10**6)",
    "ostium.rollout(model, [data.get_state()] * 2, np.array([[data.inputs] * 10**4] * 2), hold=100)",
    "ostium.run_script('rca-mid-focal', 'pci-rca-mid-focal')",
])
def test_ctrl_c_ends_a_call(call):  # each would take minutes
    program = f"""
import os, signal, threading, time, numpy as np, ostium
model = ostium.Model(ostium.Vessel("rca-mid-focal"), tools=[("w", "wire-014-workhorse")], begin="RCA")
data = ostium.Data(model)
threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
began = time.time()
try:
    {call}
except KeyboardInterrupt:
    raise SystemExit(0 if time.time() - began < 30 else 2)
"""
    assert subprocess.run([sys.executable, "-c", program], capture_output=True).returncode == 0
