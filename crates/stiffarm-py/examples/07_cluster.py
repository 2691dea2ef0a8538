"""Joint stiffness known to +-30 %: how often does each robot win? On all cores here, or on a cluster."""

import stiffarm
from stiffarm import cluster

# Workers start by importing this file: what starts them stands here.
if __name__ == "__main__":
    robots = [stiffarm.Robot(name) for name in ("KR 210 R2700 extra", "IRB 6650S-200", "ES200RD II", "IRB 6400 2.4-200")]
    found = cluster.sweep(
        robots,
        tasks=["A:0.3", "B:0.5"],
        scenarios=cluster.spread(200, percent=30, robots=len(robots), seed=0),
        folder="07_cluster",  # finished with the next call where this one is stopped
        workers=2,  # or client="tcp://scheduler:8786"
    )
    wins = found.wins()
    print("\n".join(wins.summary))
    columns = ["task", "robot", "estimated", "share", "share_low", "share_high", "p05_mm", "median_mm", "p95_mm"]
    print(wins.to_pandas()[columns].to_string(index=False))

    found.plot(task="B:0.5").figure.savefig("07_cluster.png", dpi=120)
