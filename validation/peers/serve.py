"""Process that runs a measure's function: it answers requests until there are no more.

What the function's module does to its process, it does here: to leave it, to print, to change
global state. Every exception becomes the text of a reply.
"""

import os
import sys
from multiprocessing.connection import Connection

import msgspec

from rockshape.errors import one_line
from validation.errors import InputError
from validation.peers.call import check_convention, measured_table
from validation.peers.declare import declared_traits
from validation.peers.function import Function, load_function
from validation.peers.messages import MAX_BYTES, Description, Reply, Request


def main() -> None:
    """Serve the function `argv[3]`; `argv[1:3]` are file descriptors of requests and replies."""
    reads, writes = int(sys.argv[1]), int(sys.argv[2])
    os.set_inheritable(reads, False)
    os.set_inheritable(writes, False)
    requests, replies = Connection(reads, writable=False), Connection(writes, readable=False)
    function, description = _described(sys.argv[3])
    replies.send_bytes(msgspec.msgpack.encode(description))
    while function is not None:
        try:
            packed = requests.recv_bytes(MAX_BYTES)
        except EOFError:
            return
        request = msgspec.msgpack.decode(packed, type=Request)
        replies.send_bytes(msgspec.msgpack.encode(_answer(function, request)))


def _described(target: str) -> tuple[Function | None, Description]:
    try:
        function = load_function(target)
        check_convention(function, where=f"--measure {target}")
        traits = {str(name): str(trait) for name, trait in declared_traits(function).items()}
        module = sys.modules[target.partition(":")[0]]
        return function, Description(traits=traits, source=getattr(module, "__file__", None) or "")
    except InputError as error:
        return None, Description(error=one_line(str(error)))
    except BaseException as error:
        return None, Description(error=f"--measure {target}: {_named(error)}")


def _answer(function: Function, request: Request) -> Reply:
    try:
        table = measured_table(function, request.seen(), where=request.where)
        names = [str(name) for name in table if name not in ("rock", "reason")]
        columns = {name: table[name].to_list() for name in names}
        return Reply(columns=columns)
    except InputError as error:
        return Reply(error=one_line(str(error)))
    except BaseException as error:
        return Reply(error=f"{request.where}: {_named(error)}")


def _named(error: BaseException) -> str:
    """Kind and text of an exception, also of one whose text raises another."""
    try:
        return one_line(f"{type(error).__name__}: {error}")
    except BaseException:
        return type(error).__name__
