/* Runs inside the traced program. Fake calls, made up by the recorder, that return nothing. */
#pragma once

/**
 * Write a call that readers execute like any other.
 * @param kinds  a letter for each argument, which gives its type in `...`:
 *               e enumerant, u unsigned, t truth: unsigned; i: int; l: long; f: double; o, an offset in a buffer: long;
 *               m attribute groups, c buffers to clear: unsigned; s, a text: const char *;
 *               b, memory of the recorder's own: const void *, long bytes
 */
void fake_call(unsigned command, const char *kinds, ...);
