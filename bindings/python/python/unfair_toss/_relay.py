"""What the program of the checks starts in place of a solver: it passes lines on between the program and the process in
which the function is. It is run by its path, without the package, so that it starts in a moment."""

import os
import socket
import sys


def main() -> None:
    port, token = os.environ["UNFAIR_TOSS_RELAY"].split()
    with socket.create_connection(("127.0.0.1", int(port))) as connection, connection.makefile("rwb") as function:
        function.write(token.encode() + b"\n" + sys.stdin.buffer.readline())
        for question in sys.stdin.buffer:
            function.write(question)
            function.flush()
            answer = function.readline()
            if not answer:
                return
            sys.stdout.buffer.write(answer)
            sys.stdout.buffer.flush()


if __name__ == "__main__":
    main()
