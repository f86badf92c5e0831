"""Learn to hold the ROV with Stable-Baselines3, and say whether that beats a law that was derived.

Needs `pip install 'umbilical[rl]' stable-baselines3`, which brings torch (some gigabytes). STEPS is far too small to
learn anything; what it shows is how the pieces meet.
"""

import gymnasium
from stable_baselines3 import PPO  # pyright: ignore[reportMissingImports]
from stable_baselines3.common.env_checker import check_env  # pyright: ignore[reportMissingImports]
from stable_baselines3.common.monitor import Monitor  # pyright: ignore[reportMissingImports]

import umbilical
from umbilical.interop.policies import Nothing, OuterLaw, play

STEPS = 2048
ENV = "umbilical.interop.gymnasium:Umbilical/Tip-v0"

# Every episode another draw: payload, thrusters, sea and faults are not what was assumed.
env = gymnasium.make(ENV, study="paper-robustness", arm="proposed", step=0.1, thrust_scale=400.0)
check_env(env.unwrapped)
model = PPO("MlpPolicy", Monitor(env), seed=0, n_steps=512, device="cpu").learn(STEPS)

# The same episode for everybody.
exam = gymnasium.make(ENV, scenario="paper", step=0.1, thrust_scale=400.0)
slow = {f"control.{name}_observer.time_constant": 0.2 for name in ("velocity", "slope")}
policies = {
    "nothing": Nothing(exam),
    "boundary law": OuterLaw(exam, umbilical.load("paper", {"control.law.damping_gain": 1000.0} | slow)),
    f"PPO after {STEPS} steps": lambda observation: model.predict(observation, deterministic=True)[0],
}
for name, policy in policies.items():
    print(f"{name:>24}: return {play(exam, policy, seed=0):.4g}")
