import math
import numpy as np
from vibroimpact.exact.engine.compiled import compiled, unfolded, inlined
from vibroimpact.exact.engine import march as m
from vibroimpact.exact.engine.march import *
from vibroimpact.exact.engine.event_loop import go_on, kept_progress, keep_progress, PLACES, EARLIER, FINISHED, PAUSED, Progress
from vibroimpact.exact.engine.motion import Log, Motion, pack, ROW, ENTRIES, EVENTS as NOTED
from vibroimpact.exact.engine.flow import unpacked, flow_of, tables_of
from vibroimpact.exact.engine.phase import phase_at
from vibroimpact.system.matrices import stiffness_matrix, damping_matrix

H = 0.45

def constants(system, tau0=0.0):
    flow = flow_of(system)
    q = flow.coefficients
    c = np.zeros(m.CONSTANTS)
    K, C = stiffness_matrix(system), damping_matrix(system)
    a = np.sqrt(np.linalg.norm(K, 2)) + np.linalg.norm(C, 2)
    fastest = max(a, system.Omega)
    j = int(H / fastest / flow.spacing)
    P = flow.series[0, j][:, [0, 8, 1, 9]].T
    c[:24] = P.ravel()
    c[m.CA], c[m.SA] = flow.rotations[j]
    c[m.STEP] = j * flow.spacing
    c[m.K11], c[m.K12], c[m.K22], c[m.C11], c[m.C12], c[m.C22] = q.k11, q.k12, q.k22, q.c11, q.c12, q.c22
    c[m.F1], c[m.F2], c[m.OMEGA], c[m.EPSILON], c[m.KAPPA] = q.f1, q.f2, q.omega, q.epsilon, q.kappa
    c[m.IMPULSE], c[m.REST], c[m.GROUND], c[m.DRIVE] = q.impulse, q.impulse_rest, q.ground, q.drive
    far = max(1.0, 1 / np.sqrt(q.ground))
    w = q.omega
    c[m.BEND] = a**4 * far / 72
    c[m.BEND0] = q.drive * (a**3 + a*a*w + a*w*w + w**3) * far / 72
    c[m.ROUND], c[m.ROUND0] = m.EPS * 6 * far, m.EPS * (2 + q.shift)
    c[m.FIRST], c[m.FIRST_TAIL] = phase_at(tau0, system.Omega)
    c[m.UNIT] = flow.unit
    return c

@compiled
def loop(numbers, series, rotations, constant, starts, cycles, final, status, share, stats):
    flow = unpacked(numbers, series, rotations)
    runs, c, work = np.zeros((m.STATES, 8)), np.zeros((m.CONSTANTS, 8)), np.empty((2 * m.ORDER + 2, 8))
    members = np.full(8, -1)
    counters, where_, rows = np.zeros(ENTRIES), np.zeros(PLACES), np.empty((64, ROW))
    no_times, no_samples = np.empty(0), np.empty((0, 8))
    begun = 0
    while True:
        alive = 0
        for lane in range(8):
            if members[lane] < 0 and begun < len(starts):
                n = begun
                begun += 1
                members[lane] = n
                for k in range(m.CONSTANTS):
                    c[k, lane] = constant[k]
                for k in range(m.STATES):
                    runs[k, lane] = 0.0
                runs[m.PHASE, lane], runs[m.TAIL, lane] = c[m.FIRST, lane], c[m.FIRST_TAIL, lane]
                for i in range(4):
                    runs[i, lane], runs[4 + i, lane] = starts[n, 2 * i], starts[n, 2 * i + 1]
                runs[m.ALIVE, lane] = 1.0
                runs[m.STOP, lane] = cycles
                runs[m.LARGEST1, lane] = runs[m.LARGEST2, lane] = np.inf
                runs[m.DUE, lane] = -1.0
                _begin(runs, c, lane)
            if members[lane] >= 0:
                alive += 1
            else:
                runs[m.ALIVE, lane] = 0.0
        if alive == 0:
            return
        stats[0] += march(runs, c, max(1, int(alive * share)))
        stats[1] += 1
        if meet(runs, c, work) == 0:
            continue
        for lane in range(8):
            if runs[m.OUTCOME, lane] == m.STOPPED:
                n = members[lane]
                for i in range(4):
                    final[n, 2 * i], final[n, 2 * i + 1] = runs[i, lane], runs[4 + i, lane]
                stats[2] += runs[m.EVENTS, lane]
                members[lane] = -1
            elif runs[m.OUTCOME, lane] == m.DOUBT:
                stats[3] += 1
                stats[4] += runs[m.DUE, lane] >= 0.0
                boxes = (runs[0, lane], runs[1, lane], runs[2, lane], runs[3, lane])
                balls = (runs[4, lane], runs[5, lane], runs[6, lane], runs[7, lane])
                phase, tail = ahead(runs[m.PHASE, lane], runs[m.TAIL, lane], flow.coefficients.omega, runs[m.PASSED, lane])
                turns = int(runs[m.TURNS, lane])
                if phase >= TWO_PI:
                    (phase, tail), turns = reduced(phase, tail), turns + 1
                motion = Motion(boxes, balls, (0, 0), (0, 0), 0.0, 1.0)
                progress = Progress(motion, int(runs[m.DUE, lane]), phase, tail, turns, 1.0, 0, 0)
                counters[:] = 0.0
                outcome = PAUSED
                while True:
                    stats[5] += 1
                    progress, outcome = go_on(flow, progress, (c[m.FIRST, lane], c[m.FIRST_TAIL, lane]), cycles, 0.0, no_times, no_samples, Log(rows, counters), 0.0, np.int64(0))
                    for e in range(int(counters[NOTED])):
                        stats[6] += rows[e, 3] == 0
                    counters[NOTED] = 0.0
                    if outcome != PAUSED or (progress.motion.walls[0] == 0 and progress.motion.walls[1] == 0):
                        break
                motion = progress.motion
                if outcome != PAUSED:
                    n = members[lane]
                    status[n], members[lane] = outcome, -1
                    pack(motion.boxes, motion.balls, final[n])
                    stats[2] += runs[m.EVENTS, lane]
                    continue
                for i in range(4):
                    runs[i, lane], runs[4 + i, lane] = motion.boxes[i], motion.balls[i]
                runs[m.PHASE, lane], runs[m.TAIL, lane], runs[m.TURNS, lane] = progress.phase, progress.tail, progress.revolutions
                runs[m.DUE, lane] = progress.due
                _begin(runs, c, lane)

@unfolded
def _begin(runs, c, lane):
    b1, b2, e1, e2 = runs[0, lane], runs[1, lane], runs[2, lane], runs[3, lane]
    phase, tail = runs[m.PHASE, lane], runs[m.TAIL, lane]
    runs[m.SINE, lane], runs[m.COSINE, lane] = math.sin(phase), math.cos(phase)
    runs[m.TRIAL, lane] = c[m.STEP, lane]
    runs[m.PASSED, lane] = 0.0
    runs[m.TOUCH1, lane] = runs[m.TOUCH2, lane] = 0.0
    size = math.sqrt(e1 * e1 + e2 * e2 + b1 * b1 + c[m.GROUND, lane] * b2 * b2 - c[m.K12, lane] * (b1 - b2)**2)
    runs[m.SIZE, lane] = size
    whole = runs[m.STOP, lane] - runs[m.TURNS, lane]
    left = (whole * TWO_PI - ((phase - c[m.FIRST, lane]) + (tail - c[m.FIRST_TAIL, lane])) + whole * TWO_PI_TAIL) / c[m.OMEGA, lane]
    runs[m.REACH, lane] = min(left, LONGEST)
    runs[m.LIMIT, lane] = -1.0   # first step by a pass
