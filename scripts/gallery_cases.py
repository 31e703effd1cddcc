"""The numbers of scripts/gallery: for each scene, what the lecture notes have and what `twin` computes.

The notes' side comes from tests/reference/note_cases.json, or from a formula of theirs evaluated here; the other
side from `twin` with the case's own parameters, in a scene made for it.
"""

import math

from gallery_numbers import CASES, Row, hertz, of_case, parameters

THEORY = "theory"  # of systems that the lecture notes do not have


def demo(twin):
    rotor = {"mass": 2.0, "stiffness": 7200.0, "damping": 12.0, "eccentricity": 1e-4, "speed": 0.0}  # zeta 0.05
    state = twin.analyze("jeffcott_rotor", rotor)
    p = state["natural_frequencies"][0]
    rows = [of_case("jeffcott.wpeak.z0.05", "largest whirl at w/p, zeta = 0.05", state["critical_speeds"][0]["speed"] / p,
                    "E29")]
    for ratio in ("0.5", "0.9", "2"):
        end = twin.on_scene("simulate", "jeffcott_rotor", {**rotor, "speed": float(ratio) * p},
                            options=("--duration", "20"))
        rows.append(of_case(f"jeffcott.r_e.z0.05_b{ratio}", f"whirl r/e at w/p = {ratio}", end["whirl_radius"] / 1e-4))
    rows.append(of_case("jeffcott.phi.z0.05_b2", "its phase lag at w/p = 2", end["whirl_phase"] % (2.0 * math.pi),
                        unit="rad"))
    case = parameters("whirl.internal.wcrit.ce0_ci1")
    whirling = twin.analyze("jeffcott_rotor", {"mass": case["m"], "stiffness": case["k"], "damping": 2.0,
                                               "internal_damping": case["ci"], "eccentricity": 0.0, "speed": 5.0})
    growth = max(value[0] for value in whirling["eigenvalues"])
    return rows + [of_case("whirl.internal.growth.w5", "internal damping: largest real part at 5 rad/s", growth, unit="1/s"),
                   Row("internal damping: whirls by itself above p (1 + ce/ci)",
                       math.sqrt(case["k"] / case["m"]) * (1.0 + 2.0 / case["ci"]),
                       whirling["margins"]["instability_speed"], "from the notes' equations", "rad/s")]


def spinning_pendulum(twin):
    def at(speed, length=0.2032, gravity=9.8044, initial=None):
        return twin.analyze("spinning_pendulum", {"mass": 0.5, "length": length, "speed": speed}, gravity, initial)

    rows = []
    for rpm in (0, 30, 40, 50, 60):
        identity = f"spinning.f.{rpm}rpm"
        state = at(parameters(identity)["w"])
        rows.append(of_case(identity, f"8-inch pendulum at {rpm} rpm", hertz(state["natural_frequencies"][0]), unit="Hz"))
    rest = at(0.0)["natural_frequencies"][0] * 60.0 / (2.0 * math.pi)
    rows.append(of_case("spinning.rpm0", "speed at which it leaves the vertical", rest, unit="rpm"))
    above = at(9.0, initial={"theta": 0.9})
    cone = max(e["state"]["theta"] for e in above["equilibria"] if e["verdict"] != "unstable")
    return rows + [of_case("spinning.theta0.w9", "the cone on which it rests at 9 rad/s", cone, "E32", "rad"),
                   of_case("spinning.p.w9", "frequency about it", above["natural_frequencies"][0], unit="rad/s")]


def double_pendulum(twin):
    ones = {"mass1": 1.0, "mass2": 1.0, "length1": 1.0, "length2": 1.0}
    absolute = twin.analyze("double_pendulum", ones, 1.0)
    relative = twin.analyze("double_pendulum", {**ones, "coordinates": "relative"}, 1.0)
    shapes = absolute["methods"]["mode_shapes"]
    turned = relative["methods"]["mode_shapes"]
    name = "double_pendulum"
    return [of_case(f"{name}.lam1", "2 - sqrt 2 = p1^2 l/g", absolute["natural_frequencies"][0] ** 2),
            of_case(f"{name}.lam2", "2 + sqrt 2 = p2^2 l/g", absolute["natural_frequencies"][1] ** 2),
            of_case(f"{name}.char1", "coefficient of lambda^2", -absolute["characteristic_polynomial"][2]),
            of_case(f"{name}.char0", "constant of that polynomial", absolute["characteristic_polynomial"][4]),
            of_case(f"{name}.ratio1", "mode 1: theta2/theta1", shapes[0][1] / shapes[0][0]),
            of_case(f"{name}.ratio2", "mode 2: theta2/theta1", shapes[1][1] / shapes[1][0], "E10"),
            of_case(f"{name}.rel.ratio1", "mode 1: theta3/theta1", turned[0][1] / turned[0][0]),
            of_case(f"{name}.f2.M11", "relative angles: M11", relative["linearization"]["mass"][0][0]),
            of_case(f"{name}.f2.K11", "relative angles: K11", relative["linearization"]["stiffness"][0][0], "E11")]


def linear_system(twin):
    third, ninth = 1.0 / 3.0, 11.0 / 9.0
    lever = {"mass": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
             "stiffness": [[1, third, 0], [third, ninth, -1], [0, -1, 1]]}
    methods = twin.analyze("linear_system", lever)["methods"]
    a = methods["influence_coefficients"]

    def assumed(*shapes):
        columns = [list(column) for column in zip(*shapes)]
        return twin.analyze("linear_system", {**lever, "assumed_modes": columns})

    one = assumed((1, -1, -1.5))
    two = assumed((1, -1, -1.5), (1, -2, -3))
    static = assumed((-4, 15, 16))
    case = parameters("submarine.p3.1_1000_1")
    kb = case["kb"]
    free = twin.analyze("linear_system", {
        "mass": [[case["m1"], 0, 0], [0, case["m2"], 0], [0, 0, case["m3"]]],
        "stiffness": [[kb, -2 * kb, kb], [-2 * kb, 4 * kb, -2 * kb], [kb, -2 * kb, kb]]})
    return [of_case("lever3.p1", "lever: exact p1 / sqrt(k/m)", methods["lowest_frequency"]["exact"]),
            of_case("lever3.a11", "influence coefficient a11 k", a[0][0]),
            of_case("lever3.a22", "influence coefficient a22 k", a[1][1], "E21"),
            of_case("lever3.a33", "influence coefficient a33 k", a[2][2]),
            of_case("dunkerley3.tr", "trace of [a][m] k/m", a[0][0] + a[1][1] + a[2][2]),
            of_case("dunkerley3.p1", "Dunkerley, from below", methods["lowest_frequency"]["dunkerley_lower"]),
            of_case("amm3.static.p1", "static deflection as mode", static["natural_frequencies"][0]),
            of_case("amm3.two.p1", "two assumed modes, from above", two["natural_frequencies"][0], "E19"),
            of_case("amm3.two.p1sq", "its square", two["natural_frequencies"][0] ** 2, "E19"),
            of_case("amm3.one_mode.p1", "one assumed mode", one["natural_frequencies"][0]),
            of_case("amm3.two.coef2", "two modes: coefficient of p^2, 67/18",
                    two["characteristic_polynomial"][2] * CASES["amm3.two.coef4"]["expected"], "E18"),
            of_case("submarine.p3.1_1000_1", "submarine, heavy middle: p3", free["natural_frequencies"][-1], unit="rad/s"),
            of_case("submarine.nzero.1_1000_1", "its rigid-body modes", len(free["methods"]["rigid_body_modes"]))]


def cantilever_beam(twin):
    def with_modes(modes):
        return twin.analyze("cantilever_beam", {"mass_per_length": 1.0, "length": 1.0, "bending_stiffness": 1.0,
                                                "modes": modes})["natural_frequencies"]

    two, eight = with_modes(2), with_modes(8)
    return [of_case("cantilever.p1", "x^2, x^3: p1 sqrt(m L^4/EI)", two[0], "E23"),
            of_case("cantilever.p2", "x^2, x^3: p2", two[1], "E23"),
            of_case("cantilever.lam1", "its lambda1 = p1^2", two[0] ** 2, "E22"),
            of_case("cantilever.lam2", "its lambda2", two[1] ** 2, "E22"),
            of_case("cantilever.charB", "lambda1 + lambda2", two[0] ** 2 + two[1] ** 2),
            of_case("cantilever.charC", "lambda1 lambda2", (two[0] * two[1]) ** 2, "E22"),
            of_case("cantilever.exact.p1", "exact p1; eight terms", eight[0]),
            of_case("cantilever.ritz8.p2", "p2 of eight terms", eight[1])]


def friction_oscillator(twin):
    rows = []
    for identity in [name for name in CASES if name.startswith("friction.f.")]:
        case = parameters(identity)
        state = twin.analyze("friction_oscillator", {
            "mass": 1.0, "friction_coefficient": case["mu"], "half_spacing": case["a"], "height": case["h"],
            "roller_speed": 1.0}, case["g"])
        erratum = "" if CASES[identity]["printed_matches"] else "E34"
        rows.append(of_case(identity, f"a = {case['a'] / 0.0254:g} in, h = {case['h'] / 0.0254:g} in, mu = {case['mu']:g}",
                            hertz(state["natural_frequencies"][0]), erratum, "Hz"))
    return rows


def free_rotor(twin):
    def run(identity, duration):
        case = parameters(identity)
        rotor = {"mass": case["m"], "stiffness": case["k"], "damping": case["c"], "eccentricity": case["e"],
                 "polar_inertia": case["J"], "torque": case["Tq"]}
        return twin.on_scene("simulate", "free_rotor", rotor, initial={"spin_rate": 2.0},
                             options=("--duration", duration))["state"]

    captured = "sommerfeld.w1.Tq0.1"
    started = "traj.jeffcott_spin.t5"
    start = run(f"{started}.phi_d", "5")
    return [of_case(captured, "0.1 N m from 2 rad/s: caught below the critical speed, at",
                    run(captured, "120")["spin_rate"], unit="rad/s", tolerance=1e-5),
            of_case(f"{started}.phi_d", "0.03 N m: spin speed after 5 s", start["spin_rate"], unit="rad/s"),
            of_case(f"{started}.X", "0.03 N m: x after 5 s",
                    start["xi"] * math.cos(start["spin"]) - start["eta"] * math.sin(start["spin"]), unit="m")]


def two_bar_linkage(twin):
    def equilibrium(identity):
        case = parameters(identity)
        return twin.analyze("two_bar_linkage", {"bar_mass": case["m"], "bar_length": case["l"], "force": case["P"]},
                            case["g"])

    def stable(state):
        return next(e["state"]["theta"] for e in state["equilibria"] if e["verdict"] != "unstable")

    ratio = equilibrium("two_bar.tan_ratio")
    heavy = equilibrium("two_bar.theta0.P100_m2_l1")
    return [of_case("two_bar.tan_ratio", "tan(theta) / (P / m g)", math.tan(stable(ratio)), "E01"),
            of_case("two_bar.theta0.P100_m2_l1", "theta at P = 100 N, m = 2 kg", stable(heavy), "E01", "rad"),
            of_case("two_bar.p2.P100_m2_l1", "p^2 about it", heavy["natural_frequencies"][0] ** 2, unit="1/s^2")]


def sprung_inverted_pendulum(twin):
    m, length, k, g = 1.0, 1.0, 30.0, 9.81
    state = twin.analyze("sprung_inverted_pendulum", {"mass": m, "length": length, "stiffness": k}, g)
    beta = m * g / (k * length)
    leaning = max(e["state"]["theta"] for e in state["equilibria"] if e["verdict"] == "unstable")
    at_barrier = twin.analyze("sprung_inverted_pendulum", {"mass": m, "length": length, "stiffness": k}, g,
                              {"theta": leaning})
    barrier = at_barrier["energy"]["potential"]
    return [Row("upright: p = sqrt(k/m - g/L)", math.sqrt(k / m - g / length), state["natural_frequencies"][0],
                "from the notes' equations", "rad/s"),
            Row("falls beyond acos(m g / k L)", math.acos(beta), leaning, "from the notes' equations, E36", "rad"),
            Row("energy that takes it there, (k L - m g)^2 / 2k", (k * length - m * g) ** 2 / (2.0 * k), barrier,
                "from the notes' equations, E35", "J")]


def governor(twin):
    rows = []
    for damping in ("0.1", "0.4", "1"):
        identity = f"governor.margin.c{damping}"
        case = parameters(identity)
        state = twin.analyze("governor", {"mass": case["m"], "length": case["l"], "inertia": case["J"],
                                          "damping": case["c"], "torque": case["kap"], "load": case["F"]},
                             case["g"], {"theta": 1.0, "phi_rate": 8.0})
        leading, a2, a1, a0 = state["reduced"]["characteristic_polynomial"]
        rows.append(of_case(identity, f"cubic, A1 A2 - A0 at c = {damping} N m s", (a1 * a2 / leading - a0) / leading))
    example = twin.routh(1.0, 3.0, 4.0, 2.0)
    quartic = twin.routh(1.0, 6.0, 18.0, 24.0, 16.0)
    case = CASES["routh.quartic.A3"]
    rows.append(Row("s^3 + 3 s^2 + 4 s + 2: roots to the right", 0, example["right"], "printed: stable"))
    rows.append(Row("s^4 + 6 s^3 + 18 s^2 + 24 s + 16: roots to the right", 0, quartic["right"], "printed: stable, E37"))
    # Routh's first column holds A2 - A1/A3 and A1 - A3 A0 / (A2 - A1/A3); their product with A3 is the criterion.
    column = quartic["first_column"]
    rows.append(of_case("routh.quartic.margin", "its A1 A2 A3 - A1^2 - A3^2 A0",
                        column[2] * column[3] * case["expected"], "E37"))
    return rows


def hinged_beam(twin):
    def beam(identity):
        case = parameters(identity)
        return case, twin.analyze("hinged_beam", {"geometry": "small", "mass": case["M"], "length": case["l"],
                                                  "stiffness": case["k"], "damping": case["c"]})

    case, stiff = beam("rigid_beam.p.M30_k20000")
    _, light = beam("rigid_beam.zeta.M1_k1")
    _, scene = beam("rigid_beam.ccrit.M12_k4000")
    return [of_case("rigid_beam.p.M30_k20000", "p = sqrt(3k/4M), M = 30 kg, k = 20 kN/m",
                    stiff["methods"]["undamped_natural_frequencies"][0], unit="rad/s"),
            of_case("rigid_beam.zeta.M30_k20000", "its damping ratio 3c/(2 M p)", stiff["damping_ratios"][0]),
            of_case("rigid_beam.zeta.M1_k1", "damping ratio, M = 1 kg, k = 1 N/m", light["damping_ratios"][0]),
            of_case("rigid_beam.ccrit.M12_k4000", "this scene: critical damping 2 M p/3",
                    6.0 / scene["damping_ratios"][0], unit="N s/m")]


def rod_slider(twin):
    case = parameters("rod_slider.pr.k60")
    state = twin.analyze("rod_slider", {"slider_mass": case["m0"], "rod_mass": case["m"], "rod_length": case["l"],
                                        "stiffness": case["k"], "free_length": case["r0"]}, case["g"],
                         {"r": case["r0"]})
    hanging = next(e["state"]["r"] for e in state["equilibria"] if e["verdict"] != "unstable")
    upright = next(e["state"]["r"] for e in state["equilibria"] if e["verdict"] == "unstable")
    swing, bounce = state["natural_frequencies"]
    return [of_case("rod_slider.rst0.k60", "rest of the slider, rod hanging", hanging, unit="m"),
            of_case("rod_slider.rstpi.k60", "rest of the slider, rod upright", upright, unit="m"),
            of_case("rod_slider.ptheta.k60", "the rod's swing", swing, "E08", "rad/s"),
            of_case("rod_slider.pr.k60", "the slider's bounce", bounce, unit="rad/s")]


def rolling_disc(twin):
    even = parameters("rolling_disc.zeta.m2_J0.04")
    state = twin.analyze("rolling_disc", {"disc_mass": even["m"], "disc_inertia": even["J"], "radius": even["r"],
                                          "stiffness": even["k"], "damping": even["c"]})
    uneven = parameters("eccentric_disc.p.M3_l0.2_k20")
    lopsided = twin.analyze("rolling_disc", {
        "disc_mass": uneven["M"], "disc_inertia": 0.5 * uneven["M"] * uneven["r"] ** 2, "radius": uneven["r"],
        "stiffness": uneven["k"], "offset_mass": uneven["m"], "offset": uneven["l"]}, uneven["g"])
    return [of_case("rolling_disc.zeta.m2_J0.04", "even disc: damping ratio", state["damping_ratios"][0], "E05"),
            Row("even disc: p = sqrt(k / (m + J/r^2))",
                math.sqrt(even["k"] / (even["m"] + even["J"] / even["r"] ** 2)),
                state["natural_frequencies"][0], "from the notes' equations", "rad/s"),
            of_case("eccentric_disc.p.M3_l0.2_k20", "uneven disc: p about x = 0", lopsided["natural_frequencies"][0],
                    "E07", "rad/s")]


def cart_pendulum(twin):
    case = parameters("cart.antires.theta")
    cart = {"cart_mass": case["m1"], "rod_mass": case["m2"], "rod_length": case["l"], "stiffness": case["k"]}

    def amplitude(coordinate, **drive):
        response = twin.analyze("cart_pendulum", {**cart, **drive})["methods"]["steady_response"][0]
        return response["amplitude"][coordinate] * math.cos(response["lag"][coordinate])

    free = twin.analyze("cart_pendulum", cart)
    still = CASES["cart.antires.theta"]["expected"]
    absorber = CASES["cart.antires.x"]["expected"]
    return [of_case("cart.p2_2.m1_2_k30", "free: p2^2", free["natural_frequencies"][1] ** 2, unit="1/s^2"),
            of_case("cart.frf.F.Theta", "swing under 4 N at the tip at 3 rad/s, linear",
                    amplitude("theta", force_amplitude=4.0, force_frequency=3.0), unit="rad"),
            Row(f"the same at sqrt(k / (m1 + m2/2)) = {still:.6g} rad/s", 0.0,
                amplitude("theta", force_amplitude=4.0, force_frequency=still), "from the notes' equations", "rad"),
            Row(f"cart on a support moving 0.2 m at sqrt(3g/2l) = {absorber:.6g} rad/s", 0.0,
                amplitude("x", support_amplitude=0.2, support_frequency=absorber), "from the notes' equations", "m")]


def rotating_pendulum(twin):
    rows = []
    for speed in ("6", "10"):
        case = parameters(f"rotpend.p.J0.05_w{speed}")
        # The start is on the cone itself: theta0 and w give the momentum that both keep.
        state = twin.analyze("rotating_pendulum", {"mass": case["m"], "length": case["l"], "hub_inertia": case["J"]},
                             case["g"], {"theta": math.acos(case["g"] / (case["l"] * case["w"] ** 2)),
                                         "phi_rate": case["w"]})
        cone = max(e["state"]["theta"] for e in state["equilibria"] if e["verdict"] != "unstable")
        rows += [of_case(f"rotpend.p.J0.05_w{speed}", f"frequency about the cone at {speed} rad/s, spin free",
                         state["reduced"]["natural_frequencies"][0], unit="rad/s"),
                 Row(f"the cone at {speed} rad/s, acos(g / l w^2)", math.acos(case["g"] / (case["l"] * case["w"] ** 2)),
                     cone, "from the notes' equations", "rad")]
    return rows


def sliding_mass_flywheel(twin):
    j, m, k, a, w = 0.05, 0.3, 200.0, 0.2, 15.0
    r = k * a / (k - m * w ** 2)
    wheel = {"inertia": j, "slider_mass": m, "stiffness": k, "free_length": a}
    state = twin.analyze("sliding_mass_flywheel", wheel, initial={"rho1": r, "rho2": r, "phi_rate": w})
    against, together = state["reduced"]["natural_frequencies"]
    steady = state["equilibria"][0]
    return [Row("steady radius k a / (k - m w^2) at 15 rad/s", r, steady["state"]["rho1"],
                "from the notes' equations, E43", "m"),
            Row("together: p^2 = k/m - w^2 + 8 m r^2 w^2 / (J + 2 m r^2)",
                k / m - w ** 2 + 8.0 * m * r ** 2 * w ** 2 / (j + 2.0 * m * r ** 2), together ** 2,
                "from the notes' equations, E45", "1/s^2"),
            Row("against each other: p^2 = k/m - w^2", k / m - w ** 2, against ** 2, "from the notes' equations", "1/s^2"),
            Row("roots to the right, wherever the motion exists", 0, state["reduced"]["routh"]["right"], "E46")]


def mass_spring_damper(twin):
    m, k, c = 1.0, 100.0, 2.0
    state = twin.analyze("mass_spring_damper", {"mass": m, "stiffness": k, "damping": c})
    zeta = c / (2.0 * math.sqrt(k * m))
    return [Row("rings at sqrt(k/m - c^2/4m^2)", math.sqrt(k / m) * math.sqrt(1.0 - zeta ** 2),
                max(root[1] for root in state["eigenvalues"]), THEORY, "rad/s"),
            Row("damping ratio c / (2 sqrt(k m))", zeta, state["damping_ratios"][0], THEORY),
            Row("log decrement", 2.0 * math.pi * zeta / math.sqrt(1.0 - zeta ** 2), state["margins"]["log_decrement"],
                THEORY)]


def elastic_pendulum(twin):
    m, k, free, g = 1.0, 78.4532, 0.375, 9.80665
    state = twin.analyze("elastic_pendulum", {"mass": m, "stiffness": k, "free_length": free}, g, {"r": free})
    hanging = max(e["state"]["r"] for e in state["equilibria"] if e["verdict"] != "unstable")
    swing, bounce = state["natural_frequencies"]
    length = free + m * g / k
    return [Row("hangs at r0 + m g / k", length, hanging, THEORY, "m"),
            Row("swings at sqrt(g/l)", math.sqrt(g / length), swing, THEORY, "rad/s"),
            Row("bounces at sqrt(k/m), here twice that", math.sqrt(k / m), bounce, THEORY, "rad/s")]


def shaken_upright(length, a, frequency, g, steps=1000):
    """Half the trace of the transition matrix over a period of Mathieu's equation of an upright pendulum,
    x'' = (g - a W^2 cos W t) x / l, by Runge-Kutta's method of order 4."""
    def slope(t, x):
        return x[1], (g - a * frequency ** 2 * math.cos(frequency * t)) / length * x[0]

    def plus(x, h, rate):
        return x[0] + h * rate[0], x[1] + h * rate[1]

    h = 2.0 * math.pi / frequency / steps
    trace = 0.0
    for column in range(2):
        x = (1.0 - column, float(column))
        for i in range(steps):
            t = i * h
            k1 = slope(t, x)
            k2 = slope(t + 0.5 * h, plus(x, 0.5 * h, k1))
            k3 = slope(t + 0.5 * h, plus(x, 0.5 * h, k2))
            k4 = slope(t + h, plus(x, h, k3))
            x = plus(x, h / 6.0, [p + 2.0 * q + 2.0 * r + s for p, q, r, s in zip(k1, k2, k3, k4)])
        trace += x[column]
    return 0.5 * trace


def kapitza_pendulum(twin):
    length, a, frequency, g = 0.1, 0.01, 300.0, 9.80665
    state = twin.analyze("kapitza_pendulum", {"mass": 0.1, "length": length, "amplitude": a, "frequency": frequency}, g,
                         {"theta": 2.8})
    pull = (frequency * a) ** 2
    barrier = max(e["state"]["theta"] for e in state["equilibria"] if e["verdict"] == "unstable")
    lost = {margin["parameter"]: margin["lost_at"] for margin in state["parameter_margins"]["parameters"]}
    sway = math.acos(shaken_upright(length, a, frequency, g)) * frequency / (2.0 * math.pi)
    falls, stays = 130.0, 150.0
    while stays - falls > 1e-9:
        middle = 0.5 * (falls + stays)
        if shaken_upright(length, a, middle, g) > 1.0:
            falls = middle
        else:
            stays = middle
    return [Row("sways about upright as by Mathieu's equation", sway, state["natural_frequencies"][0], THEORY, "rad/s"),
            Row("falls beyond acos(-2 g l / a^2 Omega^2)", math.acos(-2.0 * g * length / pull), barrier, THEORY, "rad"),
            Row("stays upright no longer below, by that equation", stays, lost["frequency"], THEORY, "rad/s")]


def foucault_pendulum(twin):
    g = 9.80665

    def turning(length, latitude, rate):
        state = twin.analyze("foucault_pendulum", {"mass": 28.0, "length": length, "latitude": latitude,
                                                   "rotation_rate": rate}, g)
        slow, fast = state["natural_frequencies"]
        return 0.5 * (fast - slow)  # the plane turns at half the difference of the two whirls

    earth, paris = 7.292115e-5, 0.8526
    hour = 3600.0 * 180.0 / math.pi
    return [Row("the plane at Paris, w sin(latitude)", hour * earth * math.sin(paris),
                hour * turning(67.0, paris, earth), THEORY, "deg/h"),
            Row("at the pole it turns once a day", hour * earth, hour * turning(67.0, 0.5 * math.pi, earth), THEORY,
                "deg/h"),
            Row("on this scene's fast Earth", 0.1 * math.sin(paris), turning(2.0, paris, 0.1), THEORY, "rad/s",
                tolerance=1e-3)]


ROWS = {function.__name__: function for function in (
    cantilever_beam, cart_pendulum, demo, double_pendulum, elastic_pendulum, foucault_pendulum, free_rotor,
    friction_oscillator, governor, hinged_beam, kapitza_pendulum, linear_system, mass_spring_damper, rod_slider, rolling_disc, rotating_pendulum, sliding_mass_flywheel, spinning_pendulum,
    sprung_inverted_pendulum, two_bar_linkage)}
