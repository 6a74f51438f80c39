# SPDX-License-Identifier: GPL-3.0-or-later
"""Steps of the part performance: what things cost, against size and valence, beside peers."""
from steps import Effort, Step

STEPS = [
    Step("drags", "drag_performance",
         tiny=Effort("--sizes 1000 --valences 3,8 --drags 60 --peer-drags 20 --core -1 --seed {seed}", shards=2),
         quick=Effort("--sizes 1000,10000,100000,1000000 --valences 3,6,16,64,256,1000 --drags 2000 --peer-drags 100 --largest-peer 10000 --core -1 --seed {seed}", 10),
         full=Effort("--sizes 1000,10000,100000,1000000,10000000 --valences 3,6,16,64,256,1000,4000,20000 --drags 4000 --peer-drags 400 --core -1 --seed {seed}",
                     90, memory=12000)),
    Step("edits", "edit_performance",
         quick=Effort("--samples 200 --largest 100000 --largest-valence 256 --seed {seed}", 10),
         full=Effort("--seed {seed}", 60, memory=4000)),
    Step("hand", "hand_drags",
         full=Effort("--drags 100000 --work 400 --runs 3 --seed {seed}", 60, shards=3, memory=4000)),
    Step("dabs", "brush_dabs",
         quick=Effort("--level 6 --dabs 50 --seed {seed}", 5),
         full=Effort("--level 7 --dabs 1000 --seed {seed}", 60, memory=4000)),
    Step("validation", "validation",
         tiny=Effort("--largest 1000", shards=2),
         quick=Effort("--largest 100000", 5),
         full=Effort("--largest 10000000", 60, memory=12000)),
    Step("threads", "threads", full=Effort("--level 8 --threads 1,2,4 --seed {seed}", 30, memory=6000)),
    Step("ticks", "haptic_ticks", full=Effort("--runs 3", 60, memory=4000)),
]
