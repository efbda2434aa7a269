/*
 * Motions between two moments. A motion is a matrix that takes points from their old places to the new ones. A body
 * follows its screw: it turns about one axis, by the shorter way, while it slides along that axis. So a body keeps its
 * shape, whatever its origin is, and draws that share a motion share the way. Stretching is linear.
 */
#pragma once

/**
 * Take a part of a motion.
 * @param motion  affine
 * @param at      [0,1]: 0 gives the identity, 1 the motion
 * @return 1; 0: it flattens or mirrors, or is not affine, and out is undefined
 */
int pose_part(double out[16], const double motion[16], double at);
