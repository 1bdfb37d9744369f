# A sweep by Snakemake (docs/clusters.md):
#     snakemake -s scripts/sweep.smk -j 8 --config study=study.yaml results=results/study shards=16
# program=... names a mapscore that is not on the PATH.
import shlex

RESULTS, SHARDS = config["results"], int(config.get("shards", 16))
SWEEP = shlex.join([config.get("program", "mapscore"), "sweep", config["study"], "-o", RESULTS, "-q"])
SWEEP = SWEEP.replace("{", "{{").replace("}", "}}")


rule table:
    input: expand(RESULTS + "/smk/{shard}", shard=range(1, SHARDS + 1))
    output: touch(RESULTS + "/smk/all")
    shell: SWEEP


# Ends with 1, since trials are missing.
rule recording:
    output: touch(RESULTS + "/smk/recording")
    shell: SWEEP + " --merge_only || test $? -eq 1"


rule shard:
    input: RESULTS + "/smk/recording"
    output: touch(RESULTS + "/smk/{shard}")
    wildcard_constraints: shard=r"\d+"
    retries: 2
    shell: SWEEP + " --jobs 1 --shard {wildcards.shard}/" + str(SHARDS)
