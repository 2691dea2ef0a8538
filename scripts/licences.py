"""Prints the licences of all that is inside the program, for the host: every crate, with the texts that it brings, and the scripts beside them."""

import json
import subprocess
import sys
from pathlib import Path

# What others wrote and is no crate, each with its licence: NAME.LICENSE.
ASSETS = Path(__file__).resolve().parents[1] / "crates/stiffarm-ask/assets"
TEXTS = ("license", "licence", "copying", "notice", "copyright", "unlicense")


def metadata() -> dict:
    host = next(line.split()[1] for line in run("rustc", "-vV").splitlines() if line.startswith("host:"))
    return json.loads(run("cargo", "metadata", "--locked", "--format-version", "1", "--filter-platform", host))


def run(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def compiled_in(found: dict, root: str) -> list[dict]:
    """The packages that `root` needs when it runs: neither what tests it nor what builds it."""
    packages = {package["id"]: package for package in found["packages"]}
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
    open_ids = [name for name, package in packages.items() if package["name"] == root]
    seen = set(open_ids)
    while open_ids:
        for dependency in nodes[open_ids.pop()]["deps"]:
            is_normal = any(kind["kind"] is None for kind in dependency["dep_kinds"])
            if is_normal and dependency["pkg"] not in seen:
                seen.add(dependency["pkg"])
                open_ids.append(dependency["pkg"])
    foreign = (packages[name] for name in seen if packages[name]["source"] is not None)
    return sorted(foreign, key=lambda package: (package["name"], package["version"]))


def texts(package: dict) -> list[Path]:
    folder = Path(package["manifest_path"]).parent
    named = [folder / package["license_file"]] if package["license_file"] else []
    found = sorted(path for path in folder.iterdir() if path.is_file() and path.name.lower().startswith(TEXTS))
    return named + [path for path in found if path not in named]


def main() -> None:
    packages = compiled_in(metadata(), "stiffarm-cli")
    unnamed = [package["name"] for package in packages if not package["license"] and not texts(package)]
    if unnamed:
        sys.exit(f"neither a licence nor its text is known of: {', '.join(unnamed)}")
    print(f"stiffarm contains {len(packages)} crates of others. Their licences, and the texts that their crates bring:\n")
    for package in packages:
        expression = package["license"] or "see the text"
        print(f"{package['name']} {package['version']}: {expression}; {package['repository'] or 'no repository named'}")
    printed = {path.read_text(encoding="utf-8").strip(): [f"{path.stem} ({path.name})"] for path in sorted(ASSETS.glob("*.LICENSE"))}
    for package in packages:
        for path in texts(package):
            printed.setdefault(path.read_text(encoding="utf-8", errors="replace").strip(), []).append(f"{package['name']} ({path.name})")
    for text, owners in printed.items():
        print(f"\n{'=' * 100}\n{', '.join(owners)}\n{'-' * 100}\n{text}")


main()
