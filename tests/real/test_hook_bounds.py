#!/usr/bin/python3
"""A hook that writes out of bounds: Oclgrind reports the access and the line of the hook's file."""
import shutil
import subprocess

from helpers import RELUME, SCRATCH, check, finish, skip

if not shutil.which("oclgrind"):
    skip("Oclgrind is not installed (Debian has none after 12)")
hook = SCRATCH / "beyond.cl"
hook.write_text("""struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters parameters)
{
	volatile float table[4];

	for (int i = 0; i < 4 + (int)hit.front; i++)
		table[i] = hit.color.x;
	return relume_go_on();
}
""")
done = subprocess.run([
    "oclgrind", "--build-options", "-cl-opt-disable -D LANES_PORTABLE", "--max-errors", "2", RELUME, "hook", "--check",
    "--seconds", "100", hook
], capture_output=True, text=True, timeout=110)
said = done.stdout + done.stderr
check("Invalid write of size 4" in said and "At line 6" in said, f"out of bounds: {said[:600]}")
finish()
