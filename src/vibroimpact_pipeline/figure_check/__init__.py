"""The figures against their reference set: are their numbers the same, and do they draw the same pictures?"""
