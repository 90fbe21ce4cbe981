# `make` alone lists what there is. PYTHON=... picks the interpreter of a new environment,
# ARGS="..." goes to the program that the target runs.
SHELL := /bin/bash
.DEFAULT_GOAL := help
.PHONY: help demo test test-all hostile check format bench eval bench-intents bench-speech train train-detector lock clean env env-dev

PYTHON ?=
ARGS ?=
BIN := .venv/bin
PACKAGES := executive intents robot sim
MISSION := pick up the red cup and put it on the shelf

help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-7s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

demo: env ## set up, watch a humanoid put the red cup on the shelf, also on a page; then a film of it
	@$(BIN)/humanoid do "$(MISSION)" --view $(ARGS); status=$$?; \
	[[ $$status -gt 1 ]] || $(BIN)/humanoid film; exit $$status

test: env-dev ## set up, then run the tests (ARGS="-k walk" for some)
	@$(BIN)/python -m pytest --numprocesses auto --dist loadfile --no-loadscope-reorder $(ARGS)

test-all: env-dev ## all that there is: `make test`, the rest of its campaigns, every hostile input
	@$(BIN)/python -m pytest --numprocesses auto --dist loadfile --no-loadscope-reorder --all $(ARGS)

hostile: env-dev ## every hostile input; `make test` takes a share of them
	@$(BIN)/python -m pytest --numprocesses auto --hostile-all tests/hostile $(ARGS)

check: env-dev ## format, lint, types (pyright strict), who imports whom
	@$(BIN)/ruff format --check .
	@$(BIN)/ruff check .
	@$(BIN)/basedpyright
	@$(BIN)/lint-imports

format: env-dev ## let ruff format and repair what it can
	@$(BIN)/ruff format .
	@$(BIN)/ruff check --fix .

bench: env-dev ## measure; figures go to docs/benchmarks.md
	@$(BIN)/python -m benchmarks $(ARGS)

eval: env ## strike with every fault (ARGS="--seeds 20 --no-recovery" for the whole table)
	@$(BIN)/humanoid eval $(ARGS)

bench-intents: env-dev ## measure what is understood, typed and spoken (ARGS="--sets FOLDER": your sets too)
	@$(BIN)/python -m benchmarks.intents $(ARGS)

bench-speech: env-dev ## measure what is heard; needs espeak-ng (ARGS="--share 1" for every take)
	@$(BIN)/python -m benchmarks.speech $(ARGS)

train: env-dev ## learn what people say from training/sentences (ARGS="--folds 4" judges)
	@$(BIN)/python -m training $(ARGS)

train-detector: env-dev ## learn from renders to find and name things (ARGS="--ship" for the package)
	@$(BIN)/python -m training.things $(ARGS)

lock: ## resolve pyproject.toml into hashed lock files (ARGS=--upgrade for newer pins)
	@scripts/lock $(or $(PYTHON),python3) $(ARGS)

clean: ## remove the environment and everything generated
	rm -rf .venv .venv.lock build dist runs .pytest_cache .ruff_cache .hypothesis .import_linter_cache
	find $(PACKAGES) tests -name __pycache__ -prune -exec rm -rf {} +

env:
	@scripts/environment run $(PYTHON)

env-dev:
	@scripts/environment dev $(PYTHON)
