"""scripts/pack_corpus: what it makes of inputs, and the archives in tests/fuzz/corpus."""

import importlib.machinery
import importlib.util
import io
import os
import pathlib
import re
import tarfile
import unittest

SOURCE = pathlib.Path(os.environ["BIHIVE_SOURCE"])
loader = importlib.machinery.SourceFileLoader("pack_corpus", str(SOURCE / "scripts/pack_corpus"))
pack_corpus = importlib.util.module_from_spec(importlib.util.spec_from_loader("pack_corpus", loader))
loader.exec_module(pack_corpus)


def members(data):
    with tarfile.open(fileobj=io.BytesIO(data)) as tar:
        return [(member.name, tar.extractfile(member).read(), member.mtime, member.uid) for member in tar]


class PackCorpus(unittest.TestCase):
    def test_the_archive_depends_on_the_inputs_alone(self):
        packed = pack_corpus.archive([b"long input", b"b", b"", b"a"])
        self.assertEqual(packed, pack_corpus.archive([b"a", b"", b"b", b"long input"]))
        self.assertEqual(members(packed), [("0000", b"", 0, 0), ("0001", b"a", 0, 0), ("0002", b"b", 0, 0),
                                           ("0003", b"long input", 0, 0)])

    def test_the_archives_are_as_it_makes_them(self):
        archives = sorted(pack_corpus.CORPUS.glob("*.tar.xz"))
        self.assertGreater(len(archives), 5)
        for archive in archives:
            found = members(archive.read_bytes())
            inputs = {data for _, data, _, _ in found}
            self.assertEqual(found, members(pack_corpus.archive(inputs)), archive)
            named = pack_corpus.contents(pack_corpus.CORPUS / archive.name.removesuffix(".tar.xz"))
            self.assertFalse(named & inputs, archive)

    def test_files_have_names_that_a_person_gave(self):
        for file in pack_corpus.CORPUS.glob("*/*"):
            self.assertIsNone(re.fullmatch("[0-9a-f]{16,}", file.name), f"{file}: scripts/pack_corpus packs it")


if __name__ == "__main__":
    unittest.main()
