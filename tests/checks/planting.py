"""Plants faults into a small tree and runs a program of the tree on it, for the tests of the checks.

Python takes longer to start than to check a small tree. Planting loads the program once and calls its function
main(arguments) for each planted fault; `started` runs it as a process.
"""
import contextlib
import importlib.machinery
import importlib.util
import io
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # of programs without a suffix; a later test must not load it


class Planting:
    """A program and a temporary tree, `root`. The test fails at the end of `with` if an expectation failed."""

    def __init__(self, program):
        self.program = pathlib.Path(program).resolve()
        loader = importlib.machinery.SourceFileLoader(self.program.name, str(self.program))
        self.module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
        loader.exec_module(self.module)
        self.failures = 0

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name).resolve()
        return self

    def __exit__(self, kind, error, trace):
        self.folder.cleanup()
        if not kind and self.failures:
            sys.exit(1)

    def run(self, *arguments):
        """Calls main as Python does at a start; returns the exit code and the printed text."""
        output, here, code = io.StringIO(), os.getcwd(), 0
        try:
            with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
                self.module.main([str(argument) for argument in arguments])
        except SystemExit as end:
            code = end.code or 0
            if isinstance(code, str):
                print(code, file=output)
                code = 1
        finally:
            os.chdir(here)
        return code, output.getvalue()

    def started(self, *arguments):
        """Runs the program as a process; returns the exit code and the printed text."""
        ended = subprocess.run([self.program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               check=False)
        return ended.returncode, ended.stdout

    def write(self, name, text):
        """Writes a file of the tree."""
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def edit(self, name, old, new):
        """Replaces a text that the file has once."""
        text = (self.root / name).read_text()
        self.expect(text.count(old) == 1, f'{name} does not have "{old}" once: {text}')
        self.write(name, text.replace(old, new))

    def clear(self):
        """Removes all files of the tree."""
        for path in self.root.iterdir():
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink()

    def expect(self, condition, message):
        """Reports the message if the condition does not hold."""
        if not condition:
            print(message, file=sys.stderr)
            self.failures += 1
