# %% [markdown]
# # From the idea of a gripper to a catalogue, a choice, and a MuJoCo model
#
# A notebook as plain Python (Jupytext reads it); the tests run it. It writes into the working folder.

# %%
import ozols

# %% [markdown]
# ## An idea
#
# A slide pushes two rods; each turns a jaw about a pin of the frame. All joints are hinges, as one would draw it.

# %%
idea = ozols.Builder("idea", length_unit="mm", search={"options": ["cylindrical", "universal", "spherical"]})
idea.link("frame", role="frame").link("upper", role="output").link("lower", role="output")
z = (0, 0, 1)
idea.joint("slide", "frame", "driver", type="prismatic", point=(0, 0, 0), axis=(1, 0, 0), drive=True)
for jaw, side in (("upper", 1), ("lower", -1)):
    rod = f"{jaw} rod"
    idea.joint(f"{jaw} a", "driver", rod, point=(0, 10 * side, 0), axis=z)
    idea.joint(f"{jaw} b", rod, jaw, point=(30, 25 * side, 0), axis=z)
    idea.joint(f"{jaw} c", jaw, "frame", point=(35, 5 * side, 0), axis=z)
gripper = idea.build()
gripper.draw("kinematic").save("idea.svg")
print(gripper.analyze())

# %% [markdown]
# One motion, and six redundant constraints: three a contour. Built so, it binds unless every axis is true. Which redesigns let
# all of them go and keep the motion as it is?

# %%
found = gripper.search(max_mobility=1)
print(repr(found))
print(found[0])
assert gripper.analyze().states[0].redundant == 6
assert all(v.redundant == 0 and v.mobility == 1 for v in found)

# %% [markdown]
# ## A catalogue
#
# Is it the best structure there is? Here are all mirror-symmetric grippers of up to six links, laid out, searched and scored.
# On a cluster the same call takes `client=`.

# %%
grippers = ozols.catalog.build({"links": "4..6", "symmetries": ["mirror"]}, out="grippers.db")
table = grippers.to_pandas(
    "SELECT id, jaw_a_motion AS jaws, force_mean AS force, transmission, determinate_w1, best_cost "
    "FROM structures JOIN layouts l ON l.structure = id JOIN strokes k ON k.structure = id ORDER BY force_mean DESC"
)
print(table)

# %% [markdown]
# ## A choice
#
# The one that closes the hardest for the push it takes, with the cheapest redesign that has no redundant constraint.

# %%
chosen = grippers.mechanism(table["id"][0])
redesigns = chosen.search(max_mobility=1, top=5)
assert redesigns.admissible == table["determinate_w1"][0]
print(redesigns.to_pandas()[["position", "cost", "mobility", "redundant"]])
best = redesigns[0]
best.draw().save("choice.svg")

# %% [markdown]
# ## A model
#
# As MJCF, for MuJoCo; read again, it has the same figures.

# %%
model = best.mechanism()
with open("gripper.xml", "w") as file:
    file.write(model.export("mjcf"))
again = ozols.Mechanism.from_mjcf("gripper.xml").analyze("free").states[0]
print(f"gripper.xml: W = {again.mobility}, σ = {again.redundant}")
assert (again.mobility, again.redundant) == (1, 0)
