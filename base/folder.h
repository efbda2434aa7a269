/* Folders for output: made when something is to be written into them. */
#ifndef BASE_FOLDER_H
#define BASE_FOLDER_H

/** Make a folder and those above it; one that is there is fine. @return 0 or ERR_SYSTEM (reported) */
int folder_make(const char *path);

/** Make the folder that a file is to lie in, and those above it. @return 0 or ERR_SYSTEM (reported) */
int folder_make_for(const char *file);

#endif
