/*
 * Checks of the sizes in the head of a picture. OpenImageIO's readers of PNG, OpenEXR, DPX and GIF allocate and clear
 * as many bytes as a length or a size in the head says, up to 16 GiB, before they reach the end of the file.
 */
#pragma once

/**
 * Check that all lengths in the head lie within the file, and that the file can hold that number of pixels. Icons (ICO)
 * are rejected: OpenImageIO 2.4.7 writes out of bounds if one is damaged. Other formats and malformed heads pass, and
 * their reader reports what is wrong. Files that end less than a MiB early also pass, except heads of OpenEXR.
 * @return 0, or ERR_INPUT (reported)
 */
int heads_check(const char *path);
