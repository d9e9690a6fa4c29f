"""What Snakemake runs: its rules and jobs, their code, their place, their progress and costs."""
