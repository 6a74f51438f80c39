# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps of the part robustness: whether a promise breaks, on hard meshes and on one's own."""
from steps import Effort, Step

VARIED = "--broad-phase box_tree,six_lists,all_faces --seed {seed} --dump {dump}"

STEPS = [
    Step("drags_and_edits", "robustness",
         tiny=Effort("--hard --drags 30 --edits 30 --drags-on-large 0 --edits-on-large 0 --batch 10 --edit-batch 10 --dump {dump} --seed {seed}", shards=3),
         quick=Effort("--hard --drags 2000 --edits 500 --drags-on-large 50 --edits-on-large 10 --dump {dump} --seed {seed}", 10, shards=2),
         full=Effort("--hard --drags 4200000 --edits 100000 --extreme 20000 --dump {dump} --seed {seed}", 480, shards=1024),
         with_meshes="--meshes {meshes}", with_repair="--repair"),
    # The same bits by every broad phase, with clearances from narrow to wide.
    Step("broad_phases", "robustness",
         tiny=Effort(f"{VARIED} --clearance 0,1e-9 --drags 12 --edits 12", shards=2),
         quick=Effort(f"{VARIED} --clearance 0,1e-9 --drags 300 --edits 100", 10, shards=2),
         # Of meshes of valence 20,000 a drag takes seconds where all faces are asked.
         full=Effort(f"{VARIED} --hard --clearance 0,1e-12,1e-8,1e-4 --drags 10000 --edits 2000 --drags-on-large 30 --edits-on-large 10",
                     240, shards=64),
         with_meshes="--meshes {meshes}", with_repair="--repair"),
    *(Step(f"drags_with_{response}", "robustness",
           full=Effort(f"--hard --drags 100000 --edits 20000 --response {response} --dump {{dump}} --seed {{seed}}", 120, shards=64))
      for response in ("stop", "paper")),
    Step("drags_of_a_hand", "robustness",
         tiny=Effort("--hard --motion hand --least-faces 100 --drags 200 --drags-on-large 3 --edits 0 --batch 100 --seed {seed}", shards=2),
         quick=Effort("--hard --motion hand --least-faces 100 --drags 2000 --drags-on-large 20 --edits 0 --dump {dump} --seed {seed}", 10, shards=2),
         full=Effort("--hard --motion hand --least-faces 100 --drags 600000 --edits 0 --batch 5000 --dump {dump} --seed {seed}", 240, shards=128)),
    Step("drags_of_a_hand_with_stop", "robustness",
         full=Effort("--hard --motion hand --response stop --least-faces 100 --drags 5300000 --edits 0 --batch 10000 --dump {dump} --seed {seed}",
                     480, shards=256)),
    Step("ends", "certify_ends",
         tiny=Effort("--drags 2 --per-scene 1 --ways 20 --seed {seed}", shards=2),
         quick=Effort("--drags 20 --ways 200 --parts 0 --near-degenerate 0.01 --seed {seed}", 10),
         full=Effort("--drags 20000 --seed {seed}", 240, shards=128)),
    Step("sweeps_by_oracle", "test_collision", folder="test/collision",
         full=Effort("--run_test=sweeps_agree_with_the_oracle --log_level=message", 480, shards=512),
         environment={"HAPTIC_SCULPT_SWEEP_QUERIES": "{share}", "HAPTIC_SCULPT_SEED": "{seed_of_shard}"},
         promise="every sweep agrees with the rational oracle", count={"full": 10**9}),
    Step("sweeps_by_cgal", "test_collision", folder="test/collision",
         full=Effort("--run_test=sweeps_agree_with_predicates_of_cgal --log_level=message", 240, shards=128),
         environment={"HAPTIC_SCULPT_CGAL_QUERIES": "{share}", "HAPTIC_SCULPT_SEED": "{seed_of_shard}"},
         promise="every sweep agrees with CGAL's predicates", count={"full": 10**9}),
    Step("drags_by_oracle", "test_sculpting", folder="test/sculpting",
         full=Effort("--run_test=verdicts* --log_level=message", 240, shards=64),
         environment={"HAPTIC_SCULPT_EMBEDDING_MOVES": "{share}", "HAPTIC_SCULPT_SEED": "{seed_of_shard}"},
         promise="a drag is free where all pairs of faces are, at all times", count={"full": 10**6}),
    Step("axis_moves_by_oracle", "test_axis_moves", folder="test/sculpting",
         full=Effort("--run_test=free_motions_are_embedded_all_the_way --log_level=message", 240, shards=256),
         environment={"HAPTIC_SCULPT_AXIS_MOVES": "{share}", "HAPTIC_SCULPT_SEED": "{seed_of_shard}"},
         promise="a free axis move is embedded at all times looked at", count={"full": 10**6}),
]
