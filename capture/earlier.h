/* An earlier recording under the name of a new one: it is kept until the new one has begun. */
#pragma once

/**
 * Set an earlier recording aside: each of its files gets ".earlier" added to its name. Also make the folder, and check
 * that files can be written there.
 * @param trace  name of the new recording
 * @return 0, or ERR_USAGE or ERR_SYSTEM (reported), with everything as before: the name is taken by something else than
 *         a recording, or nothing can be written there
 */
int earlier_set_aside(const char *trace);

/** The new recording has begun: remove the earlier one. */
void earlier_remove(const char *trace);

/** Nothing has been recorded: give the earlier recording its name back. */
void earlier_put_back(const char *trace);
