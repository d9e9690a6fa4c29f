# The kill table, which machine.mk includes where there are faults.

.PHONY: kill-table
kill-table: | $(UV) ##- put faults into a copy, one at a time: what catches each? (FAULTS=a,b or ROTATE=3; ALL=1: how many tests?)
	@$(if $(value ROTATE),$(call WHOLE,ROTATE))
	@$(call WHOLE,CORES); $(DEV) python -m replication.commands.kill_table --cores "$$CORES" \
	  $${FAULTS:+"--faults=$$FAULTS"} $${ROTATE:+"--rotate=$$ROTATE"} $${ALL:+--all}
