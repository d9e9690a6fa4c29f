"""What several steps, and studies, share; of the steps, studies import nothing else."""
