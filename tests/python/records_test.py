# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""PDUs as objects."""
import copy
import pickle
import random
import tempfile
import unittest

import reckon
import samples

SAMPLES = dict(samples.golden())


def pdus_of(octets):
    """The PDUs in a sample, separated by their length fields."""
    while len(octets) >= 12:
        length = int.from_bytes(octets[8:10], "big")
        yield octets[:length] if length >= 12 else octets
        if length < 12:
            return
        octets = octets[length:]


class Decoding(unittest.TestCase):
    def test_every_golden_sample_comes_back_octet_for_octet(self):
        seen = 0
        for name, octets in SAMPLES.items():
            for pdu in pdus_of(octets):
                with self.subTest(name):
                    self.assertEqual(reckon.encode(reckon.decode(pdu)).hex(), pdu.hex())
                    seen += 1
        self.assertGreaterEqual(seen, 76)
        print(f"{seen} PDUs of {len(SAMPLES)} samples")

    def test_fields_have_the_names_of_the_standard(self):
        state = reckon.decode(SAMPLES["entity_state"])
        self.assertIsInstance(state, reckon.EntityState)
        self.assertEqual(state.header.pdu_type, 1)
        self.assertIsInstance(state.entity_id, reckon.EntityId)
        self.assertIsInstance(state.entity_location.x, float)
        self.assertIsInstance(state.entity_marking.entity_marking_string, str)

    def test_every_truncation_raises_with_place_and_remedy(self):
        for name, octets in SAMPLES.items():
            pdu = next(pdus_of(octets))
            for size in {0, 1, 11, 12, len(pdu) // 2, len(pdu) - 1}:
                with self.subTest(f"{name} of {size}"), self.assertRaises(reckon.DecodeError) as caught:
                    reckon.decode(pdu[:size])
                self.assertEqual(caught.exception.rule, "E-TRUNCATED")
                self.assertRegex(str(caught.exception), r"^octet 0: .*; give all octets")

    def test_the_place_is_the_octet_of_the_damaged_pdu(self):
        fire = reckon.encode(reckon.Fire())
        damaged = fire[:8] + (40).to_bytes(2, "big") + fire[10:40]
        with self.assertRaises(reckon.DecodeError) as caught:
            reckon.decode_datagram(fire + damaged)
        self.assertEqual((caught.exception.octet, caught.exception.rule), (96, "E-LENGTH"))

    def test_more_than_one_pdu_is_refused_with_the_remedy(self):
        fire = reckon.encode(reckon.Fire())
        with self.assertRaisesRegex(reckon.DecodeError, r"octet 96: .*decode_datagram"):
            reckon.decode(fire + fire)
        self.assertEqual(len(reckon.decode_datagram(fire + fire)), 2)

    def test_other_than_octets_is_a_type_error(self):
        for given in ("text", 5, None):
            with self.assertRaises(TypeError):
                reckon.decode(given)
        self.assertIsInstance(reckon.decode(bytearray(SAMPLES["fire"])), reckon.Fire)

    def test_a_type_without_a_table_keeps_its_octets(self):
        octets = bytearray(SAMPLES["fire"])
        octets[2] = 200
        pdu = reckon.decode(octets)
        self.assertIsInstance(pdu, reckon.UnknownPdu)
        self.assertEqual(reckon.encode(pdu), bytes(octets))

    def test_octets_behind_the_last_field_are_shown_and_kept(self):
        for name in ("entity_state", "fire", "data", "transmitter"):
            with self.subTest(name):
                pdu = SAMPLES[name]
                self.assertEqual(reckon.decode(pdu).trailing, b"")
                self.assertNotIn("trailing", repr(reckon.decode(pdu)))
                longer = pdu[:8] + (len(pdu) + 5).to_bytes(2, "big") + pdu[10:] + b"\x01\x02\x03\x04\x05"
                made = reckon.decode(longer)
                self.assertEqual(made.trailing, b"\x01\x02\x03\x04\x05")
                self.assertTrue(repr(made).endswith(", trailing=b'\\x01\\x02\\x03\\x04\\x05')"))
                self.assertEqual(reckon.encode(made), longer)

    def test_signal_with_its_length_in_octets_loses_none(self):
        signal = reckon.encode(reckon.Signal(data=bytes(range(1, 14))))  # 13 octets, 3 of padding
        self.assertEqual(reckon.decode(signal).trailing, b"")
        for size in (13, 14, 15, 16):
            wrong = signal[:8] + (32 + size).to_bytes(2, "big") + signal[10:28] + (13).to_bytes(2, "big")
            wrong = (wrong + signal[30:])[:32 + size]
            made = reckon.decode(wrong)
            self.assertEqual((made.data, made.trailing), (bytes([1, 2]), wrong[36:]))
            self.assertEqual(reckon.encode(made), wrong)

    def test_the_seeds_of_the_fuzz_targets_raise_or_come_back(self):
        generator, told = random.Random(1), {"decoded": 0, "refused": 0, "same": 0}
        with tempfile.TemporaryDirectory() as folder:
            for path in samples.fuzz_seeds(folder):
                seed = path.read_bytes()
                for change in range(4):
                    octets = bytearray(seed)
                    for _ in range(change * min(1, len(octets))):
                        octets[generator.randrange(len(octets))] = generator.randrange(256)
                    self.look_at(bytes(octets), told)
        print(told)
        self.assertGreater(told["decoded"], 1000)
        self.assertGreater(told["refused"], 100)
        self.assertEqual(told["same"], told["decoded"])

    def look_at(self, octets, told):
        for pdu in pdus_of(octets):
            try:
                made = reckon.decode(pdu)
            except reckon.DecodeError:
                told["refused"] += 1
                continue
            told["decoded"] += 1
            repr(made)
            again = reckon.encode(made)
            told["same"] += again[:3] + again[4:] == pdu[:3] + pdu[4:]  # the family is derived from the type


class Encoding(unittest.TestCase):
    def test_a_pdu_made_in_python_has_its_header(self):
        octets = reckon.encode(reckon.Fire(range=900.0))
        self.assertEqual((octets[0], octets[2], octets[3], len(octets)), (7, 2, 2, 96))
        self.assertEqual(reckon.decode(octets).range, 900.0)

    def test_every_class_can_be_made(self):
        for name in reckon._pdus.__all__:
            with self.subTest(name):
                made = getattr(reckon, name)()
                self.assertIsInstance(made, reckon.Record)
                if isinstance(made, reckon.Pdu) and name != "UnknownPdu":
                    octets = reckon.encode(made)
                    self.assertEqual(reckon.encode(reckon.decode(octets)), octets)

    def test_counts_follow_the_lists(self):
        state = reckon.EntityState()
        state.variable_parameters = [reckon.ArticulatedPart(parameter_value=0.5), reckon.AttachedPart(record_type=1)]
        again = reckon.decode(reckon.encode(state))
        self.assertEqual(again.number_of_variable_parameter_records, 2)
        self.assertEqual(again.variable_parameters[0].parameter_value, 0.5)
        self.assertIsInstance(again.variable_parameters[1], reckon.AttachedPart)
        comment = reckon.Comment(variable_datum_records=[reckon.VariableDatum(variable_datum_id=9, variable_datum_value=b"hello")])
        again = reckon.decode(reckon.encode(comment))
        self.assertEqual(again.number_of_variable_datum_records, 1)
        self.assertEqual(again.variable_datum_records[0].variable_datum_value, b"hello")
        self.assertEqual(len(reckon.encode(comment)) % 8, 0)

    def test_what_does_not_fit_is_told_by_its_field(self):
        for change, sentence in (
                (lambda pdu: setattr(pdu.header, "exercise_id", 256), "PduHeader.exercise_id is 256"),
                (lambda pdu: setattr(pdu.header, "exercise_id", "one"), "PduHeader.exercise_id must be a whole number"),
                (lambda pdu: setattr(pdu.entity_location, "x", "far"), "WorldCoordinates.x must be a number"),
                (lambda pdu: setattr(pdu.entity_marking, "entity_marking_string", "twelve chars"), "at most 11"),
                (lambda pdu: setattr(pdu, "entity_location", None), "EntityState.entity_location must be a record"),
                (lambda pdu: setattr(pdu, "variable_parameters", [b"short"]), "EntityState.variable_parameters"),
                (lambda pdu: delattr(pdu, "entity_location"), "EntityState.entity_location is missing")):
            pdu = reckon.EntityState()
            change(pdu)
            with self.assertRaisesRegex((ValueError, TypeError), sentence):
                reckon.encode(pdu)
        with self.assertRaises(AttributeError):
            reckon.EntityState().entity_lokation = 1
        with self.assertRaisesRegex(TypeError, "takes a PDU"):
            reckon.encode(reckon.EntityId())

    def test_copies_and_pickles_are_equal(self):
        state = reckon.decode(SAMPLES["entity_state"])
        for other in (copy.deepcopy(state), pickle.loads(pickle.dumps(state))):
            self.assertEqual(other, state)
            other.entity_location.x += 1.0
            self.assertNotEqual(other, state)
            self.assertNotEqual(reckon.encode(other), reckon.encode(state))

    def test_the_collector_of_cycles_does_not_visit_what_was_decoded(self):
        import gc
        for _, octets in samples.golden():
            self.assertFalse(gc.is_tracked(reckon.decode(octets)))

    def test_a_pdu_is_freed_with_all_that_is_in_it(self):
        import tracemalloc
        octets = [octets for _, octets in samples.golden()]

        def round_trips():
            for one in octets:
                reckon.encode(reckon.decode(one))

        round_trips()
        tracemalloc.start()
        round_trips()
        before = tracemalloc.get_traced_memory()[0]
        for _ in range(20):
            round_trips()
        self.assertLess(tracemalloc.get_traced_memory()[0] - before, 4096)
        tracemalloc.stop()


if __name__ == "__main__":
    unittest.main()
