# The example of docs/trajectories.md.
import subprocess

from dask.distributed import Client


def part(k, parts=8):
    with open(f"part{k}.json", "wb") as out:
        subprocess.run(["mobbscope", "conflicts", "tracks.csv", "--part", f"{k}/{parts}"], stdout=out, check=True)
    return out.name


client = Client()
files = client.gather(client.map(part, range(1, 9), retries=2))
subprocess.run(["mobbscope", "merge", *files], check=True)
