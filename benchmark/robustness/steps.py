# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps of the part robustness: whether a promise breaks, on hard meshes and on one's own."""
from steps import Effort, Step

STEPS = [
    Step("drags_and_edits", "robustness",
         tiny=Effort("--hard --drags 60 --edits 60 --batch 20 --edit-batch 20 --seed {seed}", shards=3),
         quick=Effort("--hard --drags 2000 --edits 500 --drags-on-large 200 --edits-on-large 20 --dump failures --seed {seed}", 10, shards=2),
         full=Effort("--hard --drags 4200000 --edits 100000 --extreme 20000 --dump failures --seed {seed}", 480, shards=1024),
         with_meshes="--meshes {meshes}", with_repair="--repair"),
    *(Step(f"drags_with_{response}", "robustness",
           full=Effort(f"--hard --drags 100000 --edits 20000 --response {response} --dump failures --seed {{seed}}", 120, shards=64))
      for response in ("stop", "paper")),
    Step("ends", "certify_ends",
         tiny=Effort("--drags 2 --per-scene 1 --ways 20 --seed {seed}", shards=2),
         quick=Effort("--drags 20 --ways 200 --near-degenerate 0.01 --seed {seed}", 10),
         full=Effort("--drags 20000 --seed {seed}", 240, shards=128)),
    Step("sweeps_by_oracle", "test_collision", folder="test/collision",
         full=Effort("--run_test=sweeps_agree_with_the_oracle --log_level=message", 480, shards=512),
         environment={"HAPTIC_SCULPT_SWEEP_QUERIES": "{share}", "HAPTIC_SCULPT_SEED": "{seed_of_shard}"},
         promise="every sweep agrees with the rational oracle", count={"full": 10**9}),
    Step("axis_moves_by_oracle", "test_axis_moves", folder="test/sculpting",
         full=Effort("--run_test=free_motions_are_embedded_all_the_way --log_level=message", 240, shards=256),
         environment={"HAPTIC_SCULPT_AXIS_MOVES": "{share}", "HAPTIC_SCULPT_SEED": "{seed_of_shard}"},
         promise="a free axis move is embedded at all times looked at", count={"full": 10**6}),
]
