/*
 * Finds a smallest set of things that still makes a test fail: delta debugging (Zeller and Hildebrandt, Simplifying and
 * Isolating Failure-Inducing Input, 2002), leaving out ever smaller pieces, from the end to the beginning.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

/**
 * Test some sets, in parallel.
 * @param sets   [n] of [number of things]: 1 if a thing is in the set
 * @param fails  [n], receives 1 for a set that still makes the test fail
 * @return 0 or ERR_* (reported)
 */
typedef int shrink_test(void *user, uint8_t *const *sets, size_t n, int *fails);

/**
 * Remove things that are not needed, until no single one can be removed. The result does not depend on `at_once`.
 * @param in       [n]: 1 for the things to start with, which make the test fail; receives those that are needed
 * @param at_once  number of sets to test at once
 * @return 0 or what a test returned
 */
int shrink(uint8_t *in, size_t n, size_t at_once, shrink_test *test, void *user);
