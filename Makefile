# Shortcuts: each job is a script in scripts/.

.PHONY: help demo web docs package test test-all check bench fuzz faults verify lint format clean

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' Makefile | expand -t 18

demo: ## install what the program needs, build it, render the bundled molecule
	scripts/setup demo
	scripts/demo

web: ## install what the page needs, build it into build-web/page
	scripts/setup web
	scripts/build_web

docs: ## install what the documentation needs, build it as one site into build-docs/html
	scripts/setup docs
	scripts/demo >/dev/null
	scripts/docs

package: ## program, window, page and library as Debian packages and as an archive, into build-release/packages
	scripts/setup package
	scripts/build_web
	scripts/package

test: ## install what these tests need, build, run them: what a change must pass (times: HACKING.md)
	scripts/setup build
	scripts/test --setup

test-all: ## all that and the rest: lint, sanitizers, emulated processors, fuzzing (half an hour more)
	scripts/setup all
	scripts/test all

check: ## the quick checks for daily work
	scripts/check

bench: ## measure everything of docs/performance.md, beside Embree and Tachyon (over an hour on two cores)
	scripts/setup bench
	scripts/bench

fuzz: ## random inputs against readers, scenes, server and engines for MINUTES (60), with sanitizers; goes on where it ended
	scripts/setup all
	scripts/fuzz $(or $(MINUTES),60)

faults: ## every call of the program that can fail fails in turn (some 52,000 runs, over an hour)
	scripts/setup all
	cmake --preset release && cmake --build --preset release --target bihive bihive_python faults
	tests/faults/run_faults.py build-release/bihive build-release/tests/faults.so
	PYTHONPATH=$(CURDIR)/build-release/python tests/faults/run_kills.py build-release/bihive build-release/tests/faults.so

verify: ## the intersection against the long-double oracle, ten million rays a scene (over half an hour)
	scripts/verify

lint: ## formatting, directions of includes, clang-tidy
	scripts/lint

format: ## format the sources in place
	scripts/format

clean: ## remove everything that was built
	rm -rf build build-* out
