"""Getting used to a voice: cepstra, alignment, and the map from a voice to the model's."""

from pathlib import Path

import numpy as np
import pocketsphinx
import pytest

from intents.speech import acoustics, wav
from intents.speech.acoustics import SILENCE, STATES
from intents.speech.alignment import aligned
from intents.speech.cepstra import COUNT, centred, cepstra, with_changes
from intents.speech.frontend import prepared
from intents.speech.speaker import Speaker, whose
from intents.speech.sphinx import MODEL

SOUND = Path(__file__).parent / "sounds" / "command.wav"
WORDS = [("G", "OW"), ("T", "UW"), ("DH", "AH"), ("T", "EY", "B", "AH", "L")]


@pytest.fixture(scope="module")
def model():
    return acoustics.load(MODEL)


@pytest.fixture(scope="module")
def data():
    return prepared(np.concatenate(list(wav.blocks(SOUND))))


def said(model, words=WORDS, *, each=3, seed=0):
    """Cepstra as the model has them: some frames at random of each state; and the states."""
    rng, frames, states = np.random.default_rng(seed), [], []
    for phone in (model.phones[name] for name in [SILENCE, *sum(words, ()), SILENCE]):
        for state in range(STATES):
            weights = np.exp(model.weights[phone, state, 0])
            for one in rng.choice(len(weights), each, p=weights / weights.sum()):
                deviation = model.precisions[phone, 0, one] ** -0.5
                frames.append(model.means[phone, 0, one] + 0.3 * deviation * rng.normal(size=COUNT))
                states.append((phone, state))
    return np.array(frames), np.array(states)


def likely(model, values, states):
    """How well frames fit their states [nat a frame]."""
    scores = [
        model.scores(phone, 0, values[[k]])[0] + model.weights[phone, state, 0]
        for k, (phone, state) in enumerate(states)
    ]
    return np.mean([np.logaddexp.reduce(one) for one in scores])


def other_voice(values, *, stretch=1.25, seed=1):
    """The same, said by one whose cepstra are stretched, mixed and moved."""
    mixed = np.eye(COUNT) + 0.08 * np.random.default_rng(seed).normal(size=(COUNT, COUNT))
    return values @ (stretch * mixed).T + np.linspace(3.0, -3.0, COUNT)


def test_cepstra_are_those_of_the_decoder(data, tmp_path):
    decoder = pocketsphinx.Decoder(
        hmm=str(MODEL), mfclogdir=str(tmp_path), loglevel="FATAL", lm=None,
        featparams=str(Path(acoustics.__file__).with_name("features.params")),
    )  # fmt: skip
    decoder.add_keyphrase("any", "robot")
    decoder.activate_search("any")
    decoder.start_utt()
    decoder.process_raw(data, full_utt=True)
    decoder.end_utt()
    (logged,) = tmp_path.iterdir()
    theirs = np.fromfile(logged, ">f4")[1:].reshape(-1, COUNT)
    ours = cepstra(data)
    assert abs(len(ours) - len(theirs)) <= 1
    count = min(len(ours), len(theirs)) - 1
    np.testing.assert_allclose(ours[:count], theirs[:count], rtol=1e-4, atol=1e-3)


@pytest.mark.parametrize("samples", [1, 409, 410, 411, 570, 571])
def test_no_sound_is_too_short(samples):
    assert len(cepstra(np.ones(samples, "<i2").tobytes())) == 1 + max(0, -(-(samples - 410) // 160))


def test_the_microphone_leaves_no_trace(data):
    values = cepstra(data)
    assert not np.allclose(values, centred(values))
    np.testing.assert_allclose(centred(values + np.append(0.0, np.ones(12))), centred(values))


def test_changes_of_what_stays_are_none():
    _, change, of_change = with_changes(np.ones((9, COUNT)))
    assert not change.any()
    assert not of_change.any()


def test_an_alignment_follows_the_words(model):
    values, states = said(model)
    found = aligned(values, WORDS, model)
    assert (found[:, 0] == states[:, 0]).mean() > 0.8
    assert found[0, 0] == found[-1, 0] == model.phones[SILENCE]


def test_silence_between_words_is_found_and_not_demanded(model):
    values, _ = said(model, [*WORDS[:2], (SILENCE,), *WORDS[2:]], each=5)
    found = aligned(values, WORDS, model)
    changes = np.flatnonzero(np.diff(found[:, 0]))
    spoken = [int(found[0, 0]), *(int(found[k + 1, 0]) for k in changes)]
    assert spoken.count(model.phones[SILENCE]) == 3


@pytest.mark.parametrize("frames", [1, 10, 38])
def test_words_that_take_longer_teach_nothing(model, frames):
    values, _ = said(model)
    found = aligned(values[:frames], WORDS, model)
    assert len(found) == frames
    assert Speaker().after(values[:frames], found, model).frames == 0


def test_a_stranger_is_heard_as_is(data):
    values = centred(cepstra(data))
    np.testing.assert_array_equal(Speaker().adapted(values), values)
    assert Speaker().frames == 0


def test_a_voice_that_is_got_used_to_fits_the_model_better(model):
    speaker, gains = Speaker(), []
    for seed in range(12):
        values, states = said(model, seed=seed)
        heard = other_voice(values)
        before, after = (likely(model, one, states) for one in (heard, speaker.adapted(heard)))
        gains.append(after - before)
        speaker = speaker.after(heard, states, model)
    assert gains[0] == 0
    assert min(gains[1:]) > 0
    assert min(gains[4:]) > 1.0


def test_a_voice_like_the_model_stays_nearly_as_it_is(model):
    speaker = Speaker()
    for seed in range(12):
        speaker = speaker.after(*said(model, seed=seed), model)
    values, states = said(model, seed=99)
    assert likely(model, speaker.adapted(values), states) > likely(model, values, states) - 1.0


def test_little_speech_changes_little(model):
    values, states = said(model, each=3)
    little = Speaker().after(other_voice(values[6:18]), states[6:18], model)
    much = Speaker().after(other_voice(values), states, model)
    distance = [np.abs(one.map - Speaker().map).sum() for one in (little, much)]
    assert 0 < distance[0] < distance[1]


def test_silence_teaches_nothing(model):
    values, states = said(model)
    silence = states[:, 0] == model.phones[SILENCE]
    assert Speaker().after(values[silence], states[silence], model).frames == 0


def test_an_old_voice_is_forgotten(model, monkeypatch):
    values, states = said(model)
    monkeypatch.setattr("intents.speech.speaker.HALF_LIFE_FRAMES", float(len(values)))
    speaker = Speaker()
    for _ in range(5):
        speaker = speaker.after(values, states, model)
    spoken = (states[:, 0] != model.phones[SILENCE]).sum()
    assert speaker.frames == pytest.approx(spoken * (2 - 0.5**4))


def test_who_says_nothing_is_a_stranger(model):
    known = Speaker().after(*said(model), model)
    assert whose(np.full((5, COUNT), -1.0), [known], model).frames == 0
    assert whose(said(model)[0], [], model).frames == 0
