/*
 * Runs inside the traced program. ArrayElement of client memory is written as the immediate-mode calls that it stands for (GL 2.1
 * sec. 2.8). Where other arrays lie in buffers the call itself is written, too; from Begin to End the trace has only those
 * enabled. Array state cannot be asked between Begin and End, so it is asked before Begin.
 */
#pragma once

/** Before Begin, and after End. */
void elements_begin(void);
void elements_ended(void);

/** Before ArrayElement: 1 where the call itself is to be written. */
int elements_in_buffer(int index);
