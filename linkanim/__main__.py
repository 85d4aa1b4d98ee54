"""The `linkanim` command, also as `python -m linkanim`: Ctrl-C is answered before anything is imported."""

import sys


def main() -> int:
    """Run the command line and return its exit code; 130 and one line where Ctrl-C came during the start."""
    try:
        from linkanim.child import shut_out_current_folder, stay_on_one_core

        shut_out_current_folder()
        stay_on_one_core()
        from linkanim.cli import main as run

        return run()
    except KeyboardInterrupt:
        if sys.stderr is not None:
            print("linkanim: interrupted", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
