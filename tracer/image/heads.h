/*
 * What the head of a picture claims to hold. OpenImageIO's readers of PNG, OpenEXR, DPX and GIF allocate and clear as
 * many bytes as a length or a size in the head says, up to 16 GiB, before they find that the file ends.
 */
#pragma once

/**
 * Do all lengths in the head lie within the file, and can it hold so many pixels? Icons (ICO) are refused:
 * OpenImageIO 2.4.7 writes beyond its memory where one is damaged. Other formats, and what is no head of these, pass:
 * their reader says what is wrong with them. So do files that end less than a MiB early, but for heads of OpenEXR.
 * @return 0, or ERR_INPUT (reported)
 */
int heads_check(const char *path);
