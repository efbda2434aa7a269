/*
 * Runs inside the traced program. ArrayElement from client memory is written as the equivalent immediate-mode calls (GL
 * 2.1 sec. 2.8). If other arrays are in buffers, the call itself is written as well; from Begin to End the trace has
 * only those enabled. Array state cannot be queried between Begin and End, so it is queried before Begin.
 */
#pragma once

/** Before Begin, and after End. */
void elements_begin(void);
void elements_ended(void);

/** Before ArrayElement: 1 if the call itself must be written. */
int elements_in_buffer(int index);
