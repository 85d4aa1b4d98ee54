"""Figures, charts and reports for print, drawn from the same description as the window's picture.

From the ground up; a module imports from those before it only:

    illustration  a page's pen and surface, and a picture of groups that exist already
    lettering     the letters that a document carries
    svg           items as SVG
    pdf           items as PDF
    latex         a PDF whose words LaTeX sets
    curves        quantities over one true period, beside a measured table
    sentences     what a chart shows, in sentences
    chart         a chart on a page
    polar         a vector round a turn, as a polar diagram
    deck          slides with pictures, as a file for PowerPoint and its like
    figure        one pose of a scene
    vectors       the vectors of a worked solution's loops
    free_bodies   each body of a worked solution with the forces on it
    construction  how a linkage was synthesised, and its structural error
    balance       what inertia does to the ground, without and with counterweights
    tolerances    how far a quantity may be off over a period, as a chart
    write         a figure or a chart as a file, in the format that its name's ending states
    findings      the content of a report on a scene: facts, tables, which charts
    html          a report as one page
    report        the report of a scene
"""
