"""Environments: bounds, seeds, determinism, what is reported, autoreset."""

import dataclasses
import time

import gymnasium
import numpy as np
import ostium
import pytest
from ostium.gym import TASKS, NavigationEnv
from ostium.navigation import points_along
from ostium.navigation.tasks import Moment, cathsim, steve

FORWARDS = np.array([1.0, 0.1], dtype=np.float32)
NEAR = dataclasses.replace(TASKS["CrossLesion"], targets=("RCA+25",), steps=60)  # a few steps away


def run(env, seed, steps=12, **reset):
    seen, info = env.reset(seed=seed, **reset)
    rewards = []
    for _ in range(steps):
        seen, reward, over, cut, info = env.step(FORWARDS)
        rewards.append(reward)
    return seen, rewards, info


def test_rewards_are_the_published_ones():
    on_the_way = Moment(left_m=0.1, came_m=0.004, distance_m=0.09, reached=False, peak_wall_N=0)
    there = Moment(left_m=0.0, came_m=0.002, distance_m=0.003, reached=True, peak_wall_N=0)
    assert steve(on_the_way) == pytest.approx(-0.005 + 0.004)
    assert steve(there) == pytest.approx(1 - 0.005 + 0.002)
    assert cathsim(on_the_way) == pytest.approx(-0.09) and cathsim(there) == 10


def test_points_along_a_straight_tool():
    nodes = np.zeros((11, 3))
    nodes[:, 0] = np.linspace(0, 0.1, 11)
    assert points_along(nodes, (0.0, 0.025, 1.0))[:, 0] == pytest.approx([0.1, 0.075, 0.0])
    assert (points_along(nodes[:0], (0.0, 0.02)) == 0).all()


def test_every_task_is_registered_and_can_begin():
    for name in ("CrossLesion", "BasicWireNav", "Engage", "PlaceBalloon"):
        env = gymnasium.make(f"ostium/{name}-v0")
        seen, info = env.reset(seed=1)
        inner = env.unwrapped
        assert inner.observation_space.contains(seen)
        assert all(space.is_bounded() for space in inner.observation_space.spaces.values())
        assert inner.action_space.is_bounded()
        assert info["left_m"] > 0 and not info["success"]


def test_observations_stay_within_their_bounds():
    env = NavigationEnv("CrossLesion")
    env.reset(seed=2)
    env.action_space.seed(3)
    for _ in range(15):
        seen, reward, over, cut, info = env.step(env.action_space.sample())
        assert env.observation_space.contains(seen)
        assert np.isfinite(reward)


def test_the_same_seed_is_the_same_episode():
    a, b = NavigationEnv("CrossLesion"), NavigationEnv("CrossLesion")
    (seen_a, rewards_a, info_a), (seen_b, rewards_b, info_b) = run(a, 5), run(b, 5)
    assert rewards_a == rewards_b and a.data.hash() == b.data.hash()
    assert all((seen_a[key] == seen_b[key]).all() for key in seen_a)
    run(b, 6)
    assert a.data.hash() != b.data.hash()
    run(b, 5)  # after another episode
    assert a.data.hash() == b.data.hash()


def test_targets_are_drawn_by_the_seed():
    env = NavigationEnv("BasicWireNav")
    drawn = [env.reset(seed=seed)[1]["target"] for seed in range(40)]
    assert drawn == [env.reset(seed=seed)[1]["target"] for seed in range(40)]
    vessel = env.course.patient.vessel
    names = [branch["name"] for branch in vessel.branches]
    assert {names[vessel.branch_of(target)] for target in drawn} == set(TASKS["BasicWireNav"].targets)


def test_it_arrives_and_says_so():
    env = NavigationEnv(NEAR)
    _, info = env.reset(seed=1)
    total, over, cut = 0.0, False, False
    while not (over or cut):
        _, reward, over, cut, info = env.step(FORWARDS)
        total += reward
    assert over and not cut and info["success"]
    assert info["left_m"] < 0.01 and info["steps"] < 60
    assert 0.8 < info["path_ratio"] < 2
    assert info["max_wall_N"] >= info["mean_wall_N"] >= 0
    assert total > 0.9


def test_it_is_cut_off_after_its_steps():
    env = NavigationEnv(dataclasses.replace(NEAR, steps=3))
    env.reset(seed=1)
    ends = [env.step(np.zeros(2, np.float32))[2:4] for _ in range(3)]
    assert ends == [(False, False), (False, False), (False, True)]


def test_pictures_are_the_same_for_the_same_seed():
    env = NavigationEnv("CrossLesion", image=84, render_mode="rgb_array")
    first = env.reset(seed=1)[0]["image"], env.step(FORWARDS)[0]["image"]
    env.reset(seed=2)
    again = [env.reset(seed=1)[0]["image"]]
    env.render()
    again.append(env.step(FORWARDS)[0]["image"])
    assert (first[0] == again[0]).all() and (first[1] == again[1]).all()


def test_one_of_many_is_as_alone():
    task = dataclasses.replace(TASKS["CrossLesion"], persons=(0, 0, 0))
    envs = ostium.gym.NavigationVectorEnv(task, num_envs=2)
    envs.reset(seed=[3, 9])
    for _ in range(3):
        envs.step(np.tile(FORWARDS, (2, 1)))
    for i, seed in enumerate((3, 9)):
        env = NavigationEnv(task)
        run(env, seed, steps=3)
        assert env.course.target == envs.courses[i].target
        assert env.data.hash() == envs.batch.hash(i)


def test_wrong_actions_and_tasks_raise():
    env = NavigationEnv("CrossLesion")
    env.reset(seed=1)
    for wrong in (np.zeros(3), np.zeros((1, 2)), np.zeros(4)):
        with pytest.raises(ValueError, match="shape"):
            env.step(wrong)
    envs = ostium.gym.NavigationVectorEnv("CrossLesion", num_envs=3)
    envs.reset(seed=1)
    for wrong in (np.zeros(6), np.zeros((2, 3))):
        with pytest.raises(ValueError, match="shape"):
            envs.step(wrong)
    with pytest.raises(ValueError, match="num_envs"):
        ostium.gym.NavigationVectorEnv("CrossLesion", num_envs=0)
    with pytest.raises(ValueError, match="spider"):
        NavigationEnv("CrossLesion", view="nope")
    for fault in ({"targets": ()}, {"persons": ()}, {"max_feed_m_s": 0}, {"moves": ("stent",)}):
        with pytest.raises(ValueError, match=next(iter(fault)) if fault != {"moves": ("stent",)} else "stent"):
            dataclasses.replace(TASKS["CrossLesion"], **fault)
    assert hash(dataclasses.replace(TASKS["CrossLesion"], targets=["RCA+30"]))
    with pytest.raises(RuntimeError, match="reset"):
        NavigationEnv("CrossLesion", render_mode="rgb_array").render()


def test_nan_counts_as_zero_and_is_reported():
    a, b = NavigationEnv("CrossLesion"), NavigationEnv("CrossLesion")
    a.reset(seed=1), b.reset(seed=1)
    info = a.step(np.array([0.5, np.nan]))[4]
    b.step(np.array([0.5, 0.0]))
    assert info["nan_actions"] == 1 and a.data.hash() == b.data.hash()


@pytest.mark.filterwarnings("error")
def test_infinity_is_as_much_as_the_task_allows():
    a, b = NavigationEnv("CrossLesion"), NavigationEnv("CrossLesion")
    a.reset(seed=1), b.reset(seed=1)
    a.step(np.array([np.inf, -np.inf]))
    b.step(np.array([1.0, -1.0]))
    assert a.data.hash() == b.data.hash()


def test_physical_actions_are_the_same_drives():
    a, b = NavigationEnv("CrossLesion"), NavigationEnv("CrossLesion", actions="physical")
    a.reset(seed=1), b.reset(seed=1)
    a.step(np.array([0.5, -0.5]))
    b.step(np.array([0.5 * a.task.max_feed_m_s, -0.5 * a.task.max_turn_rad_s]))
    assert a.data.hash() == b.data.hash()


def test_options_of_a_reset():
    env = NavigationEnv("CrossLesion")
    run(env, 1)
    state = env.data.get_state()
    _, info = env.reset(seed=2, options={"target": "RCA+30", "state": state})
    assert info["target"] == env.course.patient.vessel.sphere("RCA+30")
    assert (env.data.get_state().view(np.uint64) == state.view(np.uint64)).all()
    began = time.process_time()
    for _ in range(20):
        env.reset(options={"state": state})
    assert time.process_time() - began < 20 * 0.02  # nothing is simulated on the way to a state
    with pytest.raises(ValueError, match="expected person, target, state"):
        env.reset(options={"case": 1})
    with pytest.raises(ValueError):
        env.reset(options={"target": "nowhere"})
    with pytest.raises(RuntimeError, match="reset"):  # no half of an episode goes on
        env.step(FORWARDS)
    with pytest.raises(ValueError, match="BasicWireNav"):
        NavigationEnv("NoSuchTask")
    with pytest.raises(ValueError, match="84 to 512"):
        NavigationEnv("CrossLesion", image=10)
    with pytest.raises(RuntimeError, match="reset"):
        NavigationEnv("CrossLesion").step(FORWARDS)


def test_pictures_are_part_of_what_is_seen():
    env = NavigationEnv("CrossLesion", image=84, render_mode="rgb_array")
    seen, _ = env.reset(seed=1)
    assert seen["image"].shape == (84, 84, 1) and env.observation_space.contains(seen)
    assert env.render().shape == (256, 256, 3)


def test_many_do_not_depend_on_the_threads():
    results = []
    for threads in (1, 3):
        envs = gymnasium.make_vec("ostium/CrossLesion-v0", num_envs=3, threads=threads)
        seen, _ = envs.reset(seed=5)
        assert envs.observation_space.contains(seen)
        for _ in range(4):
            seen, rewards, reached, cut, infos = envs.step(np.tile(FORWARDS, (3, 1)))
        assert infos["steps"].tolist() == [4, 4, 4]
        results.append((seen, rewards))
    (seen_a, rewards_a), (seen_b, rewards_b) = results
    assert (rewards_a == rewards_b).all() and all((seen_a[key] == seen_b[key]).all() for key in seen_a)


def test_what_has_ended_begins_again_with_the_next_step():
    envs = ostium.gym.NavigationVectorEnv(dataclasses.replace(NEAR, steps=2), num_envs=2)
    envs.reset(seed=1)
    still = np.zeros((2, 2), np.float32)
    assert not envs.step(still)[3].any()
    assert envs.step(still)[3].all()
    seen, rewards, reached, cut, infos = envs.step(np.tile(FORWARDS, (2, 1)))
    assert (rewards == 0).all() and not cut.any() and (infos["steps"] == 0).all()
    assert (seen["action"] == 0).all()
    assert (envs.step(np.tile(FORWARDS, (2, 1)))[4]["steps"] == 1).all()
