/*
 * Motions between two moments. A motion is a matrix that takes points from their old positions to the new ones. A
 * body follows a screw: it turns about one axis, in the shorter direction, while it slides along that axis. It keeps
 * its shape, whatever its origin is, and draws that share a motion share the path. Stretching is linear.
 */
#pragma once

/**
 * Interpolate a motion.
 * @param motion  affine
 * @param at      [0,1]: 0 gives the identity, 1 the motion
 * @return 1; 0: it flattens or mirrors, or is not affine, and out is undefined
 */
int pose_part(double out[16], const double motion[16], double at);
