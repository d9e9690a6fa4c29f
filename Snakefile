"""Every result of Makris & Vassiliou (2014): config → steps → results → figures, claims → report.

The paper's rules are in src/steps/paper.smk, in the paper's order; what every replication does with
its results is in src/replication/rules.smk; each study has rules of its own.
"""


include: "src/replication/common.smk"


from steps.inputs import check_inputs, record_files, record_paths

read_strictly("config/config.yaml")


configfile: "config/config.yaml"


check_inputs(config, config_files(), "config/config.schema.yaml")
RECORDS = record_files()

# The paper, and its follow-up studies, each a folder (FOLLOW-UP.md).
PARTS = parts(partial(check_inputs, structures=config["structures"]))


include: "src/steps/common.smk"
include: "src/steps/paper.smk"


for name in config["studies"]:

    include: f"studies/{name}/study.smk"


include: "src/replication/rules.smk"


after_the_kernel()


rule all:
    default_target: True
    input:
        everything,
        CRATE,


onstart:
    # Every record is read before anything is computed: a bad one is told at once.
    from topheavy import read_record

    for path in RECORDS.values():
        read_record(path)
    # With its limit of 100 jobs a second Snakemake looks for jobs again, every second, once for each
    # job that has begun: a tenth of the run's processor time.
    workflow.scheduler.job_rate_limiter = None
