"""A screen for windows to open on (Xvfb), with two things that xdotool cannot do: it sets the size of pixels, and drops
files onto a window by the protocol of file managers (XDND, version 5)."""

import os
import pathlib
import subprocess
import tempfile
import time

import Xlib.display
import Xlib.protocol.event
import Xlib.X
import Xlib.Xatom


class Screen:
    """An X server on a number that is free."""

    def __init__(self, *options, dpi=None):
        read, write = os.pipe()
        command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x1000x24", "-nolisten", "tcp", *options]
        self.server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        self.state = tempfile.TemporaryDirectory()  # XDG_STATE_HOME of programs on this screen
        with os.fdopen(read) as number:
            self.display = ":" + number.readline().strip()
        # The server restarts when its last client goes; this client stays.
        self.client = Xlib.display.Display(self.display)
        if dpi is not None:
            # Desktops keep their users' choices here.
            resources = f"Xft.dpi:\t{dpi}\n".encode()
            self.root().change_property(Xlib.Xatom.RESOURCE_MANAGER, Xlib.Xatom.STRING, 8, resources)
            self.client.sync()

    def root(self):
        return self.client.screen().root

    def environment(self):
        environment = {key: value for key, value in os.environ.items() if key != "WAYLAND_DISPLAY"}
        return {**environment, "DISPLAY": self.display, "XDG_STATE_HOME": self.state.name, "LIBGL_ALWAYS_SOFTWARE": "1"}

    def end(self):
        self.client.close()
        self.server.terminate()
        self.server.wait()
        self.state.cleanup()

    def clipboard(self):
        """The text that a program has copied."""
        target, place = (self.client.intern_atom(name) for name in ("UTF8_STRING", "BIHIVE_COPIED"))
        asker = self.root().create_window(0, 0, 1, 1, 0, Xlib.X.CopyFromParent)
        asker.convert_selection(self.client.intern_atom("CLIPBOARD"), target, place, Xlib.X.CurrentTime)
        self.client.flush()
        deadline = time.monotonic() + Drag.SECONDS
        while time.monotonic() < deadline:
            if not self.client.pending_events():
                time.sleep(0.01)
                continue
            event = self.client.next_event()
            if event.type == Xlib.X.SelectionNotify:
                text = asker.get_full_property(place, target) if event.property else None
                asker.destroy()
                return text.value.decode() if text else ""
        raise AssertionError("nobody answers with what is copied")

    def pixels(self, window, x, y, width, height):
        """Red, green and blue of a part of a window, one after the other."""
        image = self.client.create_resource_object("window", int(window)).get_image(
            x, y, width, height, Xlib.X.ZPixmap, 0xFFFFFFFF
        )
        return [(image.data[i + 2], image.data[i + 1], image.data[i]) for i in range(0, len(image.data), 4)]

    def drop(self, window, paths):
        """Drags these files onto a window and drops them; returns when the window has taken them."""
        Drag(self.client, window).drop(paths)


class Drag:
    SECONDS = 600  # a busy machine takes longer

    def __init__(self, client, window):
        self.client = client
        self.target = client.create_resource_object("window", int(window))
        self.source = client.screen().root.create_window(0, 0, 1, 1, 0, Xlib.X.CopyFromParent)

    def atom(self, name):
        return self.client.intern_atom(name)

    def say(self, name, *words):
        data = (32, [self.source.id, *words, *[0] * (4 - len(words))])
        message = Xlib.protocol.event.ClientMessage(window=self.target, client_type=self.atom(name), data=data)
        self.target.send_event(message)
        self.client.flush()

    def drop(self, paths):
        uris = "".join(pathlib.Path(path).as_uri() + "\r\n" for path in paths).encode()
        self.source.set_selection_owner(self.atom("XdndSelection"), Xlib.X.CurrentTime)
        self.say("XdndEnter", 5 << 24, self.atom("text/uri-list"))
        self.say("XdndPosition", 0, 50 << 16 | 50, Xlib.X.CurrentTime, self.atom("XdndActionCopy"))
        status = self.answer("XdndStatus", uris)
        assert status[1] & 1, "the window does not take files"
        self.say("XdndDrop", 0, Xlib.X.CurrentTime)
        self.answer("XdndFinished", uris)
        self.source.destroy()
        self.client.sync()

    def answer(self, name, uris):
        """The words of the window's next message of that name. Sends the names of the files when the window asks for them."""
        deadline = time.monotonic() + self.SECONDS
        while time.monotonic() < deadline:
            if not self.client.pending_events():
                time.sleep(0.01)
                continue
            event = self.client.next_event()
            if event.type == Xlib.X.SelectionRequest:
                self.hand_over(event, uris)
            elif event.type == Xlib.X.ClientMessage and event.client_type == self.atom(name):
                return event.data[1]
        raise AssertionError(f"no {name} from the window")

    def hand_over(self, request, uris):
        request.requestor.change_property(request.property, request.target, 8, uris)
        words = {name: getattr(request, name) for name in ("time", "requestor", "selection", "target", "property")}
        request.requestor.send_event(Xlib.protocol.event.SelectionNotify(**words))
        self.client.flush()
