// SPDX-License-Identifier: BSD-3-Clause
// What each flag is called, its default and what it is. What values it takes: flag_specs.cc.
#include "apps/flags.h"

#include <gflags/gflags.h>

DEFINE_string(out, "", "Where the results go.");
DEFINE_string(model, "", "The calibrated machine, as 'hexcal calibrate' writes it.");
DEFINE_string(config,
              "",
              "Settings in a YAML file: the names of these flags, without dashes, as keys. A flag "
              "on the command line wins.");
DEFINE_string(
    solver,
    "nonlinear",
    "How base and tool are found: by the weighted nonlinear problem, or by the linearized "
    "iteration of the paper.");
DEFINE_string(residual,
              "",
              "What is compared with the prediction: the readings of all markers (maximum "
              "likelihood), or the poses of the tool that they make.");
DEFINE_string(start,
              "",
              "Where the solver starts: the best closed form, the dataset's 'initial', the "
              "identity, or one closed form by name.");
DEFINE_string(loss,
              "none",
              "How much less a pose counts the further off it is. The scale is from the data.");
DEFINE_double(loss_scale,
              0.0,
              "From how many standard deviations of a pose, all six numbers together, the loss "
              "counts it less. Goes with --loss.");
DEFINE_string(covariance,
              "model",
              "By the noise that weighs the poses, or by how their residuals really scatter "
              "(sandwich), which holds where the noise differs from pose to pose.");
DEFINE_string(
    outliers,
    "keep",
    "Poses that the others contradict (data snooping, one clean dataset in a hundred lists "
    "one): named and used all the same, or left out, the fit being that of the others.");
DEFINE_string(evaluation,
              "streamed",
              "How the nonlinear problem is evaluated: in one pass over all poses, or by one "
              "automatically differentiated residual block a pose (by markers: a reading), the "
              "reference. The solution is the same.");
DEFINE_string(error,
              "paper",
              "What the iteration makes small: the difference of pose vectors of Eq. (22), or the "
              "body twist.");
DEFINE_string(unit_magnitude,
              "approach_first",
              "How the paper's updated matrices are made unit magnitude (--error=paper).");
DEFINE_int32(iterations, 20, "Largest number of iterations.");
DEFINE_double(tolerance,
              1e-12,
              "The iteration has converged when no part of its update is larger, m and rad.");
DEFINE_double(noise_position,
              0.0,
              "One standard deviation of a measured position, each coordinate, where the dataset "
              "states no noise. Goes with --noise_orientation.");
DEFINE_double(noise_orientation,
              0.0,
              "One standard deviation of a measured orientation, about each axis, where the "
              "dataset states no noise. Goes with --noise_position.");
DEFINE_double(noise,
              1.0,
              "Factor on every standard deviation that the dataset states; 0: no noise.");
DEFINE_int64(seed, 1, "The same seed draws the same noise.");
DEFINE_int32(folds,
             5,
             "Into so many parts the poses are cut to see how well the others predict each.");
DEFINE_double(alpha, 0.01, "The chance that an effect is named where there is none.");
DEFINE_int32(
    bootstraps,
    999,
    "How often noise alone is drawn and searched in the same way, to know what chance finds. More "
    "than one over --alpha.");
DEFINE_int32(draws,
             10000,
             "How often the measurement is repeated to check the covariance; up to ten times as "
             "often where the limits do not stand still.");
DEFINE_int32(starts,
             20,
             "Starts a cell of the maps of where the linearized iterations arrive; 0: no maps.");
DEFINE_string(robot, "", "What the robot reported.");
DEFINE_string(robot_format, "", "Its format.");
DEFINE_string(robot_rotation,
              "xyz",
              "What the robot's three angles mean: the factors of the rotation from left to right, "
              "xyz being Rx Ry Rz, turns about axes that move along, as PI's U V W are.");
DEFINE_string(robot_columns,
              "",
              "The columns of x, y, z and the three angles in the robot's file, by name or number "
              "from 1, where their names do not tell.");
DEFINE_bool(robot_inverse, false, "The robot's file states the base seen from the platform.");
DEFINE_bool(measured_inverse,
            false,
            "The tracker's file states the tracker seen from the bodies, not the bodies seen from "
            "the tracker.");
DEFINE_string(base,
              "",
              "The body on the base: its name, port or serial number in the tracker's file, the "
              "names of its markers A,B,C, or 'tracker' where none is on the base and the tracker "
              "stood still.");
DEFINE_string(tool, "", "The body on the platform: its name, or the names of its markers A,B,C.");
DEFINE_string(base_body,
              "",
              "The places of the base's markers in their body, in the order of the tracker's file: "
              "a .rig or .rom file.");
DEFINE_string(tool_body, "", "The same of the tool's markers.");
DEFINE_string(kind,
              "any",
              "What the dataset has: the readings of markers, which tell most, or poses of the "
              "bodies. any: markers where their places in the bodies are known.");
DEFINE_string(pair,
              "",
              "How the tracker's rows belong to the robot's: row k to row k, all rows of file k to "
              "row k, to the nearest in time, or to that of the same label.");
DEFINE_int32(frames, 1, "So many rows of the tracker belong to each row of the robot.");
DEFINE_double(
    stops,
    0.0,
    "The robot's file is a log over time: where it stands still for so long is a pose, and "
    "the tracker's readings meanwhile, but for the first fifth, are of it.");
DEFINE_double(window, 0.05, "A reading further off in time than this belongs to no pose.");
DEFINE_double(time_offset, 0.0, "What the tracker's clock is ahead of the robot's.");
DEFINE_double(missing_value,
              0.0,
              "A point all of whose coordinates are this, in the file's unit, was not seen.");
DEFINE_bool(static_tracker, false, "Tracker and base stood still throughout.");
DEFINE_string(hexapod, "", "A YAML file with the hexapod's joints, such as another dataset.");
DEFINE_string(initial,
              "",
              "A first guess of base or tool: an easy_handeye calibration. Needs measured poses.");
DEFINE_string(map, "", "What the columns of the tracker's files mean (format columns).");
DEFINE_string(robot_map, "", "What the columns of the robot's file mean.");
DEFINE_string(name, "", "The name of the dataset.");
DEFINE_string(units, "", "The units of length and angle of a table, which states none itself.");
DEFINE_string(for,
              "",
              "What the next poses are for: the 12 parameters of base and tool, or telling the "
              "model's effects from what they could also be.");
DEFINE_int32(poses, 12, "How many poses to plan.");
DEFINE_int32(pool,
             300,
             "From so many poses within reach they are chosen; for rivals each comes with up to "
             "three settings of the covariates.");
DEFINE_string(
    requirement,
    "",
    "What accuracy is asked for, of which points of the tool, and where (docs/audit.md).");
DEFINE_string(previous,
              "",
              "The result.json of an earlier calibration: what has changed since, against its "
              "uncertainty.");
DEFINE_bool(gate, false, "Exit status 7 where a requirement fails. Goes with --requirement.");
DEFINE_string(history,
              "",
              "Append the calibration to this history, a new one if there is none: what went in, "
              "what came out, who and when (docs/history.md).");
DEFINE_string(operator, "", "Who calibrates, as history and reports shall name them.");
DEFINE_string(head,
              "",
              "verify: a hash that a report printed; the record that has it, and so all before it, "
              "must be there.");
DEFINE_int32(since, 1, "trend: from this record on; a new chart after a change that is known.");
DEFINE_int32(baseline,
             1,
             "trend: the first so many records of a dataset count as in control, whatever they "
             "say.");
DEFINE_string(settings,
              "",
              "What columns of robot_poses may be set to, in their declared units: "
              "payload=0:2:5,temperature=18:28. Other columns take values that the dataset has "
              "seen.");
DEFINE_string(dataset, "", "The dataset of the result.");
DEFINE_string(world_frame, "world", "What the others call the frame of the base's markers.");
DEFINE_string(base_frame, "base", "What they call the base of the robot.");
DEFINE_string(platform_frame, "platform", "What they call its platform.");
DEFINE_string(tool_frame, "tool", "What they call the frame of the tool's markers.");
DEFINE_string(task,
              "",
              "Do the K-th of N shares only, K from 1, and leave its results in DIR/chunks.");
DEFINE_bool(merge,
            false,
            "Put the results of all shares together; refused where some are missing.");
DEFINE_bool(retry, false, "Work again on what failed, say because its file was mended.");
DEFINE_int32(threads, 0, "Threads to use. The results do not depend on it.");
DEFINE_bool(report, false, "Write report.html, too: the result with pictures, for the browser.");
DEFINE_bool(json, false, "Print the results as JSON instead, one object a line.");
DEFINE_bool(quiet, false, "Print no results and no progress; warnings and errors stay.");
DEFINE_bool(force, false, "Replace files that hexcal did not write.");
