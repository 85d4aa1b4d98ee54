"""Recordings: frames to GIF, MP4, WebM, WebP, APNG, MOV and numbered PNG.

From the ground up; a module imports from those before it only:

    plan         how a clip is divided: how many frames, at which phases
    palette      the one palette of a GIF
    encode       frames to a file, by an encoder in a process of its own
    processes    frames drawn by several processes, in their order
    recording    drawn frames to a file that loops; `record`
    tape_frames  a tape's states as frames; `record_tape`
    lessons      a lesson as one file, or as one for each step
    gallery      every scene as a small GIF
    sheet        several scenes on one picture, all running
"""
