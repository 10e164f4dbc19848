"""Where the repository that holds this package keeps what its studies found."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
STUDIES = ROOT / "experiments/studies"
CONFIGS, SUMMARIES, QUESTIONS = STUDIES / "configs", STUDIES / "summaries", STUDIES / "questions"
